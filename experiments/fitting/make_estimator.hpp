#pragma once

#include <memory>

#include "experiments/estimators/entry.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// The condition's estimator, with the hyperparameters of its fit.
EstimatorEntry entry_of(const Experiment& experiment, const Condition& condition,
                        const FittedModels& models);

/// The setup of the condition's estimator for this run. `models` and `run` must outlive it.
EstimatorSetup setup_of(const Experiment& experiment, const Condition& condition,
                        const FittedModels& models, const RunSignals& run);

/// A new estimator of the condition for this run, which is updated step by step. Errors:
/// `InputError` for an estimator that processes whole runs only.
std::unique_ptr<ContactEstimator> make_estimator(const Experiment& experiment,
                                                 const Condition& condition,
                                                 const FittedModels& models, const RunSignals& run);

/// A new runner of the condition's estimator, which processes steps or whole runs.
EstimatorRunner runner_of(const Experiment& experiment, const Condition& condition,
                          const FittedModels& models, const RunSignals& run);

}  // namespace touchdown::experiments
