#pragma once

#include "cli/verbs.hpp"
#include "experiments/cross_simulator.hpp"

namespace touchdown {

/// Runs the robustness check, prints its report and draws its overlay.
/// Errors: those of `run_cross_simulator`; `Error` when a verdict that is demanded fails.
void check_across_simulators(const CrossSimulator& config, const RunOptions& options,
                             bool no_pictures);

}  // namespace touchdown
