#pragma once

#include "estimator/bayes_filter.hpp"
#include "estimator/contact_estimator.hpp"

namespace touchdown {

/// From the wheels' probabilities to their decisions and to the robot's probabilities. The legs
/// were estimated independently of each other, so their probabilities multiply.
inline void conclude(Belief& belief, double threshold) noexcept {
  for (WheelBelief& wheel : belief.wheel) {
    wheel.contact = wheel.p_contact >= threshold;
  }
  const double left = belief.wheel[0].p_contact;
  const double right = belief.wheel[1].p_contact;
  belief.p_both_wheels = left * right;
  belief.p_any_wheel = left + (1.0 - left) * right;
}

/// Throws InputError for a threshold outside [0, 1], a negative floor or a negative low-pass.
void check_measurement_config(const MeasurementConfig& config, double threshold);

}  // namespace touchdown
