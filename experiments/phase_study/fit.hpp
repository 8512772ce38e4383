#pragma once

#include "experiments/fitting/fitting.hpp"
#include "experiments/play/play.hpp"

namespace touchdown::experiments {

/// Fits the phase filter of every engine to pieces of its runs: 1.9 s from each of so many stairs
/// runs, 5 s of hanging and 7 s of lifting, and with other numbers of stairs runs for the learning
/// curve. Adds the models. Errors: `Error` when the fit takes more than 60 s; `Stopped`.
void fit_to_pieces(const Experiment& experiment, const PlayedRuns& runs, const GoingOn& going_on,
                   FittedModels& models);

/// How long the pieces of one engine last, with so many of stairs (s).
double fitted_seconds(const PlayedRuns& runs, const std::string& simulator, int stairs);

}  // namespace touchdown::experiments
