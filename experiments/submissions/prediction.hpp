#pragma once

#include "experiments/signals/run_signals.hpp"
#include "recordings/beliefs/beliefs.hpp"
#include "scoring/score.hpp"

namespace touchdown::experiments {

/// What was said at every step of a run.
struct SubmittedPrediction {
  scoring::Prediction prediction;
  std::size_t without = 0;  ///< steps with a record and without a belief
};

/// Each belief stands from the step that its time is next to, until the next one's; before the
/// first, p = 0.5. That any or both wheels touch has the probabilities of wheels that are
/// independent. Errors: `InputError` for a time outside of the run, or two beliefs at one step.
SubmittedPrediction prediction_of(const recordings::Beliefs& beliefs, const RunSignals& run);

}  // namespace touchdown::experiments
