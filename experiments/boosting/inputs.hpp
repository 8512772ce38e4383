#pragma once

#include <array>

#include "estimator/contact_estimator.hpp"
#include "estimator/force/leg_geometry.hpp"

namespace touchdown::experiments {

/// What inputs of boosted trees depend on.
struct TreeInputsConfig {
  double sample_rate = 1000.0;  ///< Hz
  LegGeometry legs = {};        ///< for inputs that use it
  bool servo_load = false;      ///< whether targets of the servos are used
};

/// Result of one update of such inputs.
struct TreeInputsStep {
  SignalStatus status = SignalStatus::good;
  double elapsed = 0.0;               ///< since the previous step (s)
  std::array<bool, 2> is_valid = {};  ///< whether a wheel has features in this step; left, right
};

}  // namespace touchdown::experiments
