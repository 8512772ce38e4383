#pragma once

#include <functional>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/estimators/fitted_model.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// Fits what the experiment's estimators need, for each engine on its own runs, in parallel: phase
/// models to the pieces of an engine that has any. `going_on` is asked before each density; false
/// ends it with `Stopped`.
FittedModels fit_models(const Experiment& experiment, const std::vector<RunSignals>& fit_runs,
                        const std::vector<RunSignals>& pieces = {},
                        const std::function<bool()>& going_on = {});

}  // namespace touchdown::experiments
