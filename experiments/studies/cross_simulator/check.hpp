#pragma once

#include <string>
#include <vector>

#include "experiments/studies/cross_simulator/agreement.hpp"
#include "experiments/studies/cross_simulator/transfer.hpp"
#include "experiments/studies/cross_simulator/variations.hpp"

namespace touchdown::experiments {

/// How an estimator that was fitted on the nominal scene does in a varied one.
struct Sensitivity {
  Variation variation;
  std::string estimator;
  std::size_t runs = 0;    ///< that are scored
  std::size_t failed = 0;  ///< that fell or diverged
  Interval success;        ///< NaN when no run is left
};

/// What the robustness check found out.
struct CrossSimulatorResult {
  Experiment experiment;
  Agreement agreement;
  std::vector<Transfer> transfers;
  std::vector<Sensitivity> sensitivities;
  std::vector<Verdict> verdicts;
};

/// Compares what the two engines did, what estimators lose that were fitted in the other one, and
/// what one factor at a time changes, and judges. A verdict that fails is a result, not an error.
/// Errors: `Error` when there is no test run that the robot gets through in both engines.
CrossSimulatorResult check_across_simulators(const Evaluation& evaluation);

}  // namespace touchdown::experiments
