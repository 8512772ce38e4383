#pragma once

#include <memory>

#include "experiments/estimators/entry.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// The condition's estimator, with the constants that it was fitted with.
EstimatorEntry entry_of(const Condition& condition, const FittedModels& models);

/// What the condition's estimator is made for when it listens to this run; `models` and `run` must
/// outlive it.
EstimatorSetup setup_of(const Condition& condition, const FittedModels& models,
                        const RunSignals& run);

/// A fresh estimator as the condition wants it, for this run, step by step. Errors: `InputError`
/// for one that hears whole runs.
std::unique_ptr<ContactEstimator> make_estimator(const Condition& condition,
                                                 const FittedModels& models, const RunSignals& run);

/// Likewise, however it listens.
EstimatorRunner runner_of(const Condition& condition, const FittedModels& models, const RunSignals& run);

}  // namespace touchdown::experiments
