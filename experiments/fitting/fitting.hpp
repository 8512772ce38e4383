#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/estimators/entry.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// HyperparameterValues that were chosen for estimators, by engine, then estimator.
using TunedHyperparameters = std::map<std::string, std::map<std::string, HyperparameterValues>>;

/// What was chosen, and for estimators without a choice what the experiment's file says.
TunedHyperparameters or_given(TunedHyperparameters chosen, const Experiment& experiment);

/// The runs of one engine.
std::vector<const RunSignals*> of_engine(const std::vector<RunSignals>& runs,
                                         const std::string& simulator);

/// One model, still without a passport. Errors: `InputError` for runs of reserved seeds, and what
/// the fit throws.
FittedModel fit_model(const EstimatorEntry& entry, const FitRuns& runs);

/// The passport of an estimator's model that is fitted to these runs. Chosen constants that the
/// library knows are part of how it runs the estimator; of one that it does not make, all are.
ModelMetadata new_metadata(const std::string& estimator, const FitRuns& runs,
                           const HyperparameterValues& hyperparameters);

/// Fits what the experiment's estimators need, for each engine on its own runs, in parallel: phase
/// models to the pieces of an engine that has any. Estimators that something was chosen for, or
/// given, have it in their models, also those that are not fitted. `should_continue` is asked before each
/// density; false ends it with `Stopped`.
FittedModels fit_models(const Experiment& experiment, const std::vector<RunSignals>& fit_runs,
                        const std::vector<RunSignals>& segments = {},
                        const std::function<bool()>& should_continue = {},
                        const TunedHyperparameters& chosen = {});

}  // namespace touchdown::experiments
