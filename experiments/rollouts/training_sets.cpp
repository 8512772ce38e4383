#include "experiments/rollouts/training_sets.hpp"

#include <algorithm>

#include "core/rows.hpp"
#include "experiments/rollouts/training_segments.hpp"

namespace touchdown::experiments {

TrainingPieces training_pieces(const Rollouts& runs, const Experiment& experiment) {
  TrainingPieces pieces;
  for (const std::string& simulator : experiment.simulators) {
    const RunPointers segments =
        training_segments_of(runs, simulator, experiment.training_segments);
    pieces.runs.insert(pieces.runs.end(), segments.begin(), segments.end());
  }
  if (!experiment.training_segments.empty()) return pieces;
  pieces.skip = experiment.scoring.skip;
  for (const auto& [index, run] : runs) {
    const PlannedRun& plan = run.plan;
    const bool is_wanted = plan.role == RunRole::fit && plan.fit.empty() && plan.group == 0;
    if (is_wanted && !run.failed()) pieces.runs.push_back(&run.signals);
  }
  return pieces;
}

RunPointers training_set(const RunPointers& pieces, std::size_t size) {
  RunPointers set;
  for (const auto& of_engine :
       group_by(pieces, [](const auto* run) { return run->info.simulator; })) {
    const auto scenes =
        group_by(of_engine.rows, [](const auto* run) { return run->info.scenario; });
    const std::size_t wanted = std::min(size, of_engine.rows.size());
    std::size_t taken = 0;
    for (std::size_t turn = 0; taken < wanted; ++turn) {
      for (const auto& scene : scenes) {
        if (turn >= scene.rows.size() || taken == wanted) continue;
        set.push_back(scene.rows[turn]);
        ++taken;
      }
    }
  }
  return set;
}

double used_seconds(const RunSignals& piece, double skip) {
  const double period = 1e-6 * static_cast<double>(piece.info.control_period_us);
  return std::max(0.0, static_cast<double>(piece.steps()) * period - skip);
}

}  // namespace touchdown::experiments
