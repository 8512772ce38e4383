#pragma once

#include "cli/verbs.hpp"
#include "experiments/run_experiment.hpp"

namespace touchdown {

/// Prints an experiment's result and where it is, and draws its pictures unless told not to.
void show(ExperimentResult& result, const Session& session, bool no_pictures);

}  // namespace touchdown
