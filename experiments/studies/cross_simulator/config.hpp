#pragma once

#include <string>
#include <vector>

#include "experiments/config/study_sections.hpp"

namespace touchdown::experiments {

/// One quantity of the scenario that is varied, with all others unchanged.
struct Factor {
  std::string name;
  std::string key;                      ///< of the scenario, dotted: `terrain.friction`
  std::vector<double> values;           ///< in the key's own unit
  std::vector<std::string> simulators;  ///< engines with this quantity; empty: all
};

/// The conditions for an estimator's verdict.
struct VerdictConfig {
  /// Fitted in the other engine, it must lose less accuracy than this (upper end of the paired
  /// interval).
  double largest_loss = 0.01;
  /// Fitted in the other engine, it must exceed always contact by more than this (lower end).
  double smallest_gain = 0.0;
  std::vector<std::string> demanded;  ///< estimators that must pass, or the run fails
};

/// The drop that is plotted in both engines.
struct OverlayConfig {
  int run = 0;   ///< index of the test run
  int drop = 3;  ///< of that run, from 0
};

/// The section `cross_simulator`: how much the results depend on the engine.
struct CrossSimulatorConfig {
  std::vector<Factor> factors;
  int sensitivity_runs = 4;  ///< test runs per engine and value of a factor, at most
  VerdictConfig verdict;
  OverlayConfig overlay;
};

/// The section and its keys.
StudySection cross_simulator_section();

}  // namespace touchdown::experiments
