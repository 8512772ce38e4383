#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "experiments/plan/rollouts.hpp"

namespace touchdown::experiments {

/// Replaces the signals of runs for `fit.segments` by their segments, so that memory holds segments
/// instead of whole runs. A segment has only the data that a fit needs. Its offset depends on how
/// many earlier runs of its entry did not fail, so it is cut as soon as these are there.
class SegmentCutter {
 public:
  /// `runs` must outlive the cutter, and has an entry for every planned run already.
  SegmentCutter(std::span<const TrainingSegments> segments, Rollouts& runs);

  /// Takes the index of a rollout that is in `runs` now. Several threads may call it at once.
  void add(std::size_t index);

 private:
  /// The runs of one entry, of one fit on one engine.
  struct Queue {
    std::vector<std::size_t> runs;  ///< indices, ascending
    std::size_t next = 0;           ///< first run that is not cut
    std::size_t good = 0;           ///< number of cut runs that did not fail
  };

  std::span<const TrainingSegments> segments_;
  Rollouts& runs_;
  std::mutex mutex_;
  std::map<std::tuple<std::string, std::string, std::size_t>, Queue> queues_;
  std::set<std::size_t> there_;  ///< runs that `add` got
};

/// The whole runs of one fit on one engine that did not fail. `runs` must outlive the result.
RunPointers whole_fit_runs(const Rollouts& runs, const std::string& simulator,
                           const std::string& fit = {});

/// The cut segments of one fit on one engine: for every entry, those of the first `runs` runs that
/// did not fail. `runs` must outlive the result.
RunPointers training_segments_of(const Rollouts& runs, const std::string& simulator,
                                 std::span<const TrainingSegments> segments,
                                 const std::string& fit = {});

/// What training sets are made of: the experiment's training segments, or its fitted runs if it has
/// no segments.
struct TrainingPieces {
  RunPointers runs;   ///< held by the rollouts
  double skip = 0.0;  ///< the unused beginning of each (s)
};

/// The pieces of all engines, without failed runs.
TrainingPieces training_pieces(const Rollouts& runs, const Experiment& experiment);

/// The first `size` pieces of each engine, from its scenes in turn; all of them if there are fewer.
RunPointers training_set(const RunPointers& pieces, std::size_t size);

/// The duration of a piece without its unused beginning (s).
double used_seconds(const RunSignals& piece, double skip);

}  // namespace touchdown::experiments
