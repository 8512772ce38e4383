#pragma once

#include <vector>

#include "experiments/config/study_sections.hpp"

namespace touchdown::experiments {

/// The section `learning_curve`: scores of every fitted estimator by the size of its training set
/// (docs/explanation/learning_curve.md).
struct LearningCurveConfig {
  /// Numbers of training segments, increasing; without `fit.segments`, of fitted runs. A set takes
  /// them from the scenes in turn.
  std::vector<int> sizes;
  int draws = 1;  ///< training sets of each size, with different runs
};

/// The section and its keys.
StudySection learning_curve_section();

}  // namespace touchdown::experiments
