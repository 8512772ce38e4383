#pragma once

#include "cli/verbs.hpp"
#include "experiments/run_experiment.hpp"

namespace touchdown::cli {

/// Prints an experiment's result and where it is, and draws its pictures unless told not to.
void show(experiments::ExperimentResult& result, const CliSession& session, bool no_pictures);

}  // namespace touchdown::cli
