#pragma once

#include <vector>

#include "experiments/config/study_sections.hpp"

namespace touchdown::experiments {

/// The section `odometry`: odometry on every test run, with contact from every estimator, from the
/// ground truth, and from the ground truth with these delays (docs/explanation/odometry.md).
struct OdometryStudyConfig {
  std::vector<double> delay;  ///< s
};

/// The section and its keys.
StudySection odometry_section();

}  // namespace touchdown::experiments
