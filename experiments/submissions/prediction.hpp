#pragma once

#include "experiments/signals/run_signals.hpp"
#include "recordings/log/beliefs.hpp"
#include "scoring/score.hpp"

namespace touchdown::experiments {

/// The submitted contact at every step of a run.
struct SubmittedPrediction {
  scoring::Prediction prediction;
  std::size_t without = 0;  ///< steps with a record but without a belief
};

/// Each belief holds from the step nearest to its time until the next belief; before the first,
/// p = 0.5. P(any wheel in contact) and P(both wheels in contact) follow from independent wheels.
/// Errors: `InputError` for a time outside of the run, or two beliefs at one step.
SubmittedPrediction prediction_of(const recordings::Beliefs& beliefs, const RunSignals& run);

}  // namespace touchdown::experiments
