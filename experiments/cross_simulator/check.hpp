#pragma once

#include <string>
#include <vector>

#include "experiments/cross_simulator/agreement.hpp"
#include "experiments/cross_simulator/sensitivity.hpp"
#include "experiments/cross_simulator/transfer.hpp"
#include "experiments/cross_simulator/verdict.hpp"

namespace touchdown::experiments {

/// What the robustness check found out.
struct CrossSimulatorResult {
  Experiment experiment;
  Agreement agreement;
  std::vector<Transfer> transfers;
  std::vector<Sensitivity> sensitivities;
  std::vector<Verdict> verdicts;
};

/// Compares what the two engines did, what estimators lose that were fitted in the other one, and
/// what one factor at a time changes, and judges. `counts` are those of the experiment's own test
/// runs. A verdict that fails is a result, not an error. Errors: `Error` when there is no test run
/// that the robot gets through in both engines.
CrossSimulatorResult check_across_simulators(const RunRequest& request, const Plan& plan,
                                             const PlayedRuns& runs, const CollectedCounts& counts,
                                             const SavedCounts& saved);

}  // namespace touchdown::experiments
