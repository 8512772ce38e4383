#pragma once

#include "experiments/fitting/fitting.hpp"
#include "experiments/rollouts/rollouts.hpp"

namespace touchdown::experiments {

/// Fits the phase filter of every engine to `fit.segments` with other numbers of runs of their
/// first scene, and adds the models. Errors: `Error` when the experiment's own segments last more
/// than 60 s; `Stopped`.
void fit_learning_curve(const Experiment& experiment, const Rollouts& runs,
                        const ShouldContinue& should_continue, FittedModels& models);

/// Duration of the segments of one engine with `number` runs of the first scene (s).
double fitted_seconds(const Experiment& experiment, const Rollouts& runs,
                      const std::string& simulator, int number);

}  // namespace touchdown::experiments
