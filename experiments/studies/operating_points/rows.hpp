#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/evaluation/tasks.hpp"
#include "scoring/operating_point.hpp"

namespace touchdown::experiments {

/// One estimator in one scene, engine and noise setting, with these decision thresholds.
struct OperatingRow {
  std::string simulator;
  std::string scene;
  noise::NoiseCell noise;
  std::string estimator;
  std::optional<scoring::Hysteresis> thresholds = {};  ///< empty: its own decision
  scoring::OperatingScore score = {};                  ///< of all runs, both wheels added
};

/// Rows of the experiment's own test runs, by scene, engine, estimator, noise, then thresholds: the
/// estimator's own decision first. A scene without scored runs has no rows.
std::vector<OperatingRow> operating_rows(const Evaluation& evaluation);

/// The mean over all scenes and engines, with equal weights.
struct OperatingMean {
  noise::NoiseCell noise;
  std::string estimator;
  std::optional<scoring::Hysteresis> thresholds = {};
  double balanced_accuracy = 0.0;
  double extra_switches_per_minute = 0.0;
  double false_takeoffs_per_minute = 0.0;
  double takeoff_error = 0.0;              ///< s; over scenes with detected takeoffs
  double extra_switches_per_flight = 0.0;  ///< total switches over total flights
  /// Whether no other thresholds dominate in balanced accuracy and extra switches (Pareto front).
  bool is_on_front = false;
};

/// Means by noise, estimator, then thresholds: the own decision first, which is on no front.
std::vector<OperatingMean> operating_means(const std::vector<OperatingRow>& rows);

}  // namespace touchdown::experiments
