#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "experiments/config/experiment.hpp"
#include "experiments/estimators/entry.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// Chosen values of hyperparameters, by engine, then estimator.
using TunedHyperparameters = std::map<std::string, std::map<std::string, HyperparameterValues>>;

/// Adds the values of the experiment file for estimators without chosen values.
TunedHyperparameters or_given(TunedHyperparameters chosen, const Experiment& experiment);

/// The runs of one engine.
RunPointers of_engine(const RunPointers& runs, const std::string& simulator);

/// Fits the models of the experiment's estimators, for each engine on its own runs, in parallel.
/// Every model contains the chosen or given hyperparameters, also for estimators without a fit.
/// `should_continue` is called before each fit. Errors: `Stopped` when it returns false.
FittedModels fit_models(const Experiment& experiment, const RunPointers& fit_runs,
                        const std::function<bool()>& should_continue = {},
                        const TunedHyperparameters& chosen = {});

/// Draws as many runs from these with replacement, within each scene and engine, so that every
/// scene and engine keeps its number of runs. Where every scene of an engine has one run, as drawn
/// scenes have, scenes are drawn. The draw depends only on `seed` and `number`.
RunPointers drawn_anew(const RunPointers& runs, std::uint64_t seed, int number);

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
