#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/evaluation/tasks.hpp"
#include "scoring/operating_point.hpp"

namespace touchdown::experiments {

/// One estimator in one scene, engine and noise setting, deciding by these thresholds.
struct OperatingRow {
  std::string simulator;
  std::string scene;
  noise::NoiseCell noise;
  std::string estimator;
  std::optional<scoring::Hysteresis> thresholds = {};  ///< none: its own decision
  scoring::OperatingScore score = {};                  ///< of all runs, both wheels added
};

/// Of the experiment's own test runs: by scene, engine, estimator, noise, then thresholds, its own
/// decision first. A scene without any run to score has no rows.
std::vector<OperatingRow> operating_rows(const Evaluation& evaluation);

/// The same over all scenes and engines: every one counts alike.
struct OperatingMean {
  noise::NoiseCell noise;
  std::string estimator;
  std::optional<scoring::Hysteresis> thresholds = {};
  double balanced_accuracy = 0.0;
  double extra_switches_per_minute = 0.0;
  double false_takeoffs_per_minute = 0.0;
  double takeoff_error = 0.0;              ///< s; of scenes in which takeoffs are found
  double extra_switches_per_flight = 0.0;  ///< all of them by all flights
  /// Whether no other thresholds do better in both, balanced accuracy and extra switches.
  bool is_on_front = false;
};

/// By noise, estimator, then thresholds, its own decision first, which is on no front.
std::vector<OperatingMean> operating_means(const std::vector<OperatingRow>& rows);

}  // namespace touchdown::experiments
