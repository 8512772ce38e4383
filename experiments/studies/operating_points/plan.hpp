#pragma once

#include <string_view>

#include "experiments/plan/plan.hpp"
#include "experiments/studies/operating_points/config.hpp"

namespace touchdown::experiments {

inline constexpr std::string_view operating_points_name = "operating_points";

/// Measures the own decisions of every condition that is fitted in domain, then its decisions at
/// each pair of thresholds: scores of type `scoring::OperatingScore`, over the whole run.
Measure operating_points_measure(const OperatingPointsConfig& config);

}  // namespace touchdown::experiments
