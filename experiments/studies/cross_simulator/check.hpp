#pragma once

#include <string>
#include <vector>

#include "experiments/studies/cross_simulator/agreement.hpp"
#include "experiments/studies/cross_simulator/transfer.hpp"
#include "experiments/studies/cross_simulator/variations.hpp"

namespace touchdown::experiments {

/// Scores of an estimator, fitted on the nominal scene, in a varied one.
struct Sensitivity {
  Variation variation;
  std::string estimator;
  std::size_t runs = 0;    ///< scored
  std::size_t failed = 0;  ///< fell or diverged
  Interval success;        ///< accuracy; NaN without scored runs
};

/// The result of the cross-simulator check.
struct CrossSimulatorResult {
  Experiment experiment;
  Agreement agreement;
  std::vector<Transfer> transfers;
  std::vector<Sensitivity> sensitivities;
  std::vector<Verdict> verdicts;
};

/// Compares the runs of the two engines, the loss of estimators that were fitted in the other
/// engine, and the effect of one factor at a time, and gives verdicts. A failed verdict is a
/// result, not an error. Errors: `Error` when the robot completes no test run in both engines.
CrossSimulatorResult check_across_simulators(const Evaluation& evaluation);

}  // namespace touchdown::experiments
