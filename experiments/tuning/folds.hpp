#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// One fold of a cross-validation over the fitted runs.
struct Fold {
  RunPointers fitted;    ///< training data: whole runs of all other folds
  RunPointers segments;  ///< training data: segments of runs of all other folds
  RunPointers held_out;  ///< validation data: whole runs of this fold
};

/// Assigns whole runs to folds in turn, so that each scene is spread over the folds, then the runs
/// of segments. All whole runs and segments of one draw of a scene are in the same fold. A scene
/// that is not `drawn` counts as one draw.
std::vector<Fold> folds_of(std::span<const RunSignals* const> whole,
                           std::span<const RunSignals* const> segments, std::size_t folds,
                           bool drawn);

}  // namespace touchdown::experiments
