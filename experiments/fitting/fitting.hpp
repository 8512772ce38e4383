#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/estimators/entry.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// Chosen values of hyperparameters, by engine, then estimator.
using TunedHyperparameters = std::map<std::string, std::map<std::string, HyperparameterValues>>;

/// Adds the values of the experiment file for estimators without chosen values.
TunedHyperparameters or_given(TunedHyperparameters chosen, const Experiment& experiment);

/// The runs of one engine.
RunPointers of_engine(const RunPointers& runs, const std::string& simulator);

/// Fits one model, still without metadata. Errors: `InputError` for runs of reserved seeds; the
/// errors of the entry's `fit`.
FittedModel fit_model(const EstimatorEntry& entry, const FitRuns& runs);

/// The metadata of an estimator's model that is fitted to these runs. Its configuration takes over
/// chosen values as `put_into` does.
ModelMetadata new_metadata(const std::string& estimator, const FitRuns& runs,
                           const HyperparameterValues& hyperparameters);

/// Fits the models of the experiment's estimators, for each engine on its own runs, in parallel.
/// Phase models are fitted to the engine's training segments, if it has any. Every model contains
/// the chosen or given hyperparameters, also for estimators without a fit. `should_continue` is
/// called before each density. Errors: `Stopped` when it returns false.
FittedModels fit_models(const Experiment& experiment, const RunPointers& fit_runs,
                        const RunPointers& segments = {},
                        const std::function<bool()>& should_continue = {},
                        const TunedHyperparameters& chosen = {});

}  // namespace touchdown::experiments
