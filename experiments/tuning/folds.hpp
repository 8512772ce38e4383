#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// One of the parts that fitted runs are cut into: what is fitted to the others is judged by it.
struct Fold {
  std::vector<const RunSignals*> fitted;  ///< whole runs of all other folds
  std::vector<const RunSignals*> segments;  ///< likewise, cut from runs
  std::vector<const RunSignals*> judged;  ///< whole runs of its own
};

/// Whole runs are dealt out in turn, so that each scene is spread over the folds, then the runs
/// that pieces are cut from. A draw of a scene is in one fold alone, however often it is there,
/// whole or as a piece; a scene that is not `drawn` is one such draw.
std::vector<Fold> folds_of(std::span<const RunSignals* const> whole,
                           std::span<const RunSignals* const> segments, std::size_t folds,
                           bool drawn);

}  // namespace touchdown::experiments
