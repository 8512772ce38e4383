#pragma once

#include <cstddef>

#include "experiments/rollouts/rollouts.hpp"

namespace touchdown::experiments {

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
