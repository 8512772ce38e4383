#include "experiments/play/pieces.hpp"

#include <algorithm>
#include <cmath>

namespace touchdown::experiments {

namespace {

/// What a fit needs of the steps from `begin` on.
RunSignals cut(const RunSignals& run, std::size_t begin, std::size_t length) {
  RunSignals piece;
  piece.info = run.info;
  piece.legs = run.legs;
  const auto first = static_cast<std::ptrdiff_t>(std::min(begin, run.steps()));
  const auto last = static_cast<std::ptrdiff_t>(std::min(begin + length, run.steps()));
  piece.signals.assign(run.signals.begin() + first, run.signals.begin() + last);
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    piece.contact[w].assign(run.contact[w].begin() + first, run.contact[w].begin() + last);
    piece.normal_force[w].assign(run.normal_force[w].begin() + first,
                                 run.normal_force[w].begin() + last);
  }
  return piece;
}

/// The piece of a run whose turn it is, counted from 0.
RunSignals piece_of(const RunSignals& run, const FitPieces& pieces, std::size_t turn) {
  const auto steps = [&](double seconds) {
    return static_cast<std::size_t>(
        std::llround(1e6 * seconds / static_cast<double>(run.info.control_period_us)));
  };
  const std::size_t earliest = steps(pieces.after);
  const std::size_t length = steps(pieces.length);
  const std::size_t room = run.steps() - std::min(run.steps(), earliest + length);
  const auto places = static_cast<std::size_t>(pieces.places);
  const std::size_t later = places > 1 ? room * (turn % places) / (places - 1) : 0;
  return cut(run, earliest + later, length);
}

}  // namespace

std::vector<RunSignals> pieces_of(const PlayedRuns& runs, const std::string& simulator,
                                  std::span<const FitPieces> pieces, const std::string& fit) {
  std::vector<RunSignals> all;
  for (std::size_t entry = 0; entry < pieces.size(); ++entry) {
    std::size_t taken = 0;
    for (const auto& [index, run] : runs) {
      const PlannedRun& plan = run.plan;
      const bool is_wanted = plan.role == RunRole::fit && plan.simulator == simulator &&
                             plan.fit == fit && plan.group == piece_group(entry) && !run.failed();
      if (!is_wanted || taken == static_cast<std::size_t>(pieces[entry].runs)) continue;
      all.push_back(piece_of(run.signals, pieces[entry], taken++));
    }
  }
  return all;
}

}  // namespace touchdown::experiments
