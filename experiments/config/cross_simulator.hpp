#pragma once

#include <string>
#include <vector>

namespace touchdown {
class Fields;
}

namespace touchdown::experiments {

/// One thing that is varied while all others stay as they are.
struct Factor {
  std::string name;
  std::string key;                      ///< of the scenario, dotted: `terrain.friction`
  std::vector<double> values;           ///< in the key's own unit
  std::vector<std::string> simulators;  ///< where it means something; empty: everywhere
};

/// What an estimator must do for its verdict.
struct VerdictConfig {
  /// Fitted in the other engine it may lose less than this of its success rate (upper end of the
  /// paired interval).
  double largest_loss = 0.01;
  /// Fitted in the other engine it must still beat always contact by more than this (lower end).
  double smallest_gain = 0.0;
  std::vector<std::string> demanded;  ///< estimators whose verdict must hold, or the run fails
};

/// The drop that is drawn in both engines.
struct OverlayConfig {
  int run = 0;   ///< index of the test run
  int drop = 3;  ///< of that run, from 0
};

/// The section `cross_simulator` of an experiment that asks how much its results depend on the
/// engine.
struct CrossSimulatorConfig {
  std::vector<Factor> factors;
  int sensitivity_runs = 4;  ///< test runs per engine and value of a factor, if so many
  VerdictConfig verdict;
  OverlayConfig overlay;
};

/// The experiment that the section stands in.
struct ComparedRuns {
  const std::vector<std::string>& simulators;
  const std::vector<std::string>& estimators;
  int test_runs;
};

void describe(Fields& section, CrossSimulatorConfig& config, const ComparedRuns& runs);

}  // namespace touchdown::experiments
