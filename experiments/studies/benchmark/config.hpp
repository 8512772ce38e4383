#pragma once

#include <string>
#include <vector>

#include "experiments/config/study_sections.hpp"

namespace touchdown::experiments {

/// The section `benchmark`: robots and sensors in addition to the experiment's own. Every estimator
/// is fitted to and tested on each combination. Every scene is scored separately.
struct BenchmarkConfig {
  std::vector<std::string> robots;   ///< files
  std::vector<std::string> sensors;  ///< likewise
  /// Whether estimators fitted on another robot, other sensors or the other engine are scored, too.
  bool transfer = false;
  /// How often every fit is repeated, each time with a bootstrap resample of the fitted runs.
  /// Intervals then include the variation due to the choice of fitted runs. Reference upper bounds
  /// are fitted once.
  int refits = 0;
  /// Whether refits cover all robots and sensors, or only the experiment's own.
  bool refits_everywhere = false;
  /// Whether the worst segment of every estimator is filmed, on the experiment's own robot.
  bool clips = false;
  /// The estimators of the Markdown table of unseen scenes; empty: all that are ranked.
  std::vector<std::string> table;
};

/// The section, its keys and its files.
StudySection benchmark_section();

}  // namespace touchdown::experiments
