#include "estimator/force/load_estimate.hpp"

#include <algorithm>

#include "estimator/low_pass.hpp"

namespace touchdown {

namespace {

// Chosen for 95 % of errors within two standard deviations (docs/explanation/contact.md).
constexpr double time_constant = 0.008;  // s
constexpr double torque_error = 0.07;    // N·m: offset and scale of torques, zeros of joints
constexpr double servo_error = 0.05;     // N·m: likewise by the servo law
// Shares of the robot's weight:
constexpr double model_error = 0.04;    // the leg's dynamics, the lag of the low-pass
constexpr double largest_share = 0.25;  // the largest standard deviation of a load
constexpr double gravity = 9.81;        // m/s²

}  // namespace

LoadEstimates::LoadEstimates(const LegGeometry& geometry, double sample_rate) noexcept
    : gain_(exact_low_pass_gain(time_constant, sample_rate)),
      white_(gain_ / (2.0 - gain_)),
      arms_(gain_ / (square(geometry.upper_length + geometry.lower_length) +
                     square(geometry.lower_length))),
      leg_mass_(geometry.upper_centre * geometry.upper_mass + geometry.lower_mass +
                geometry.wheel_mass),
      torque_variance_(square(torque_error)),
      servo_variance_(square(servo_error) +
                      // uniform within ± the friction
                      1.0 / 3.0 * square(std::max(geometry.hip_friction, geometry.knee_friction))),
      model_variance_(square(model_error * gravity * geometry.robot_mass)),
      largest_variance_(square(largest_share * gravity * geometry.robot_mass)) {}

}  // namespace touchdown
