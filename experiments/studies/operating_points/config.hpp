#pragma once

#include <vector>

#include "experiments/config/study_sections.hpp"
#include "scoring/operating_point.hpp"

namespace touchdown::experiments {

/// The section `operating_points`: scores of every estimator with these thresholds instead of its
/// own. Each `leave_below` is paired with each `return_above` that is not lower
/// (docs/reference/metrics.md).
struct OperatingPointsConfig {
  std::vector<double> leave_below = {0.02, 0.05, 0.1, 0.15, 0.25, 0.4, 0.5, 0.6, 0.75, 0.85, 0.95};
  std::vector<double> return_above = {0.25, 0.5, 0.75, 0.9, 0.98};
};

/// The pairs of thresholds.
std::vector<scoring::Hysteresis> points_of(const OperatingPointsConfig& config);

/// The section and its keys.
StudySection operating_points_section();

}  // namespace touchdown::experiments
