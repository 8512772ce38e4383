#include "experiments/plan/training_data.hpp"

#include <algorithm>
#include <cmath>

#include "core/rows.hpp"

namespace touchdown::experiments {

namespace {

/// The data for a fit from `length` steps of a run, from `begin` on.
RunSignals cut(const RunSignals& run, std::size_t begin, std::size_t length) {
  RunSignals segment;
  segment.info = run.info;
  segment.legs = run.legs;
  const auto first = static_cast<std::ptrdiff_t>(std::min(begin, run.steps()));
  const auto last = static_cast<std::ptrdiff_t>(std::min(begin + length, run.steps()));
  segment.signals.assign(run.signals.begin() + first, run.signals.begin() + last);
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    segment.contact[w].assign(run.contact[w].begin() + first, run.contact[w].begin() + last);
    segment.normal_force[w].assign(run.normal_force[w].begin() + first,
                                   run.normal_force[w].begin() + last);
  }
  return segment;
}

/// The segment of the run with this number, counted from 0.
RunSignals segment_of(const RunSignals& run, const TrainingSegments& segments, std::size_t number) {
  const auto steps = [&](double seconds) {
    return static_cast<std::size_t>(
        std::llround(1e6 * seconds / static_cast<double>(run.info.control_period_us)));
  };
  const std::size_t earliest = steps(segments.after);
  const std::size_t length = steps(segments.length);
  const std::size_t slack = run.steps() - std::min(run.steps(), earliest + length);
  const auto offsets = static_cast<std::size_t>(segments.offsets);
  const std::size_t later = offsets > 1 ? slack * (number % offsets) / (offsets - 1) : 0;
  return cut(run, earliest + later, length);
}

auto queue_of(const PlannedRun& run) { return std::tuple(run.fit, run.simulator, run.group); }

}  // namespace

TrainingPieces training_pieces(const Rollouts& runs, const Experiment& experiment) {
  TrainingPieces pieces;
  const std::vector<TrainingSegments>& segments = experiment.training_segments;
  for (const std::string& simulator : experiment.simulators) {
    const RunPointers more = segments.empty() ? whole_fit_runs(runs, simulator)
                                              : training_segments_of(runs, simulator, segments);
    pieces.runs.insert(pieces.runs.end(), more.begin(), more.end());
  }
  if (segments.empty()) pieces.skip = experiment.scoring.skip;
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
  const double period = piece.period();
  return std::max(0.0, static_cast<double>(piece.steps()) * period - skip);
}

SegmentCutter::SegmentCutter(std::span<const TrainingSegments> segments, Rollouts& runs)
    : segments_(segments), runs_(runs) {
  for (const auto& [index, run] : runs) {
    if (run.plan.is_of_segments()) queues_[queue_of(run.plan)].runs.push_back(index);
  }
}

void SegmentCutter::add(std::size_t index) {
  const PlannedRun& plan = runs_.at(index).plan;
  if (!plan.is_of_segments()) return;
  const std::lock_guard lock(mutex_);
  there_.insert(index);
  Queue& queue = queues_.at(queue_of(plan));
  for (; queue.next < queue.runs.size() && there_.contains(queue.runs[queue.next]); ++queue.next) {
    Rollout& run = runs_.at(queue.runs[queue.next]);
    if (run.failed()) continue;
    run.signals = segment_of(run.signals, segments_[plan.group - segment_group(0)], queue.good++);
  }
}

RunPointers whole_fit_runs(const Rollouts& runs, const std::string& simulator,
                           const std::string& fit) {
  RunPointers all;
  for (const auto& [index, run] : runs) {
    const PlannedRun& plan = run.plan;
    const bool is_wanted = plan.is_of_whole_fit() && plan.fit == fit && plan.simulator == simulator;
    if (is_wanted && !run.failed()) all.push_back(&run.signals);
  }
  return all;
}

RunPointers training_segments_of(const Rollouts& runs, const std::string& simulator,
                                 std::span<const TrainingSegments> segments,
                                 const std::string& fit) {
  RunPointers all;
  for (std::size_t entry = 0; entry < segments.size(); ++entry) {
    std::size_t taken = 0;
    for (const auto& [index, run] : runs) {
      const PlannedRun& plan = run.plan;
      const bool is_wanted = plan.role == RunRole::fit && plan.simulator == simulator &&
                             plan.fit == fit && plan.group == segment_group(entry) && !run.failed();
      if (!is_wanted || taken == static_cast<std::size_t>(segments[entry].runs)) continue;
      all.push_back(&run.signals);
      ++taken;
    }
  }
  return all;
}

}  // namespace touchdown::experiments
