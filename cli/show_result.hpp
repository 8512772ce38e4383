#pragma once

#include "cli/verbs.hpp"
#include "experiments/run_experiment.hpp"

namespace touchdown::cli {

/// Prints an experiment's result and its paths, and draws its figures and videos unless
/// `no_pictures`. Errors: `Error` if a demanded verdict fails.
void show(experiments::ExperimentResult& result, const CliSession& session, bool no_pictures);

}  // namespace touchdown::cli
