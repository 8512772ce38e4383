#pragma once

#include <functional>
#include <vector>

namespace touchdown {
class Fields;
}

namespace touchdown::policies {

/// From `time` on, bends the legs until the hip is at this angle.
struct CrouchCommand {
  double time = 0.0;  ///< s
  double hip = 0.0;   ///< forward positive (rad); 0: straight legs
  double rate = 0.3;  ///< of the hip angle (rad/s)
};

/// Crouch commands, sorted by time. Before the first one the legs keep their initial posture.
using CrouchScript = std::vector<CrouchCommand>;

/// Bound of joint angles in files (rad). Robots have their own ranges.
inline constexpr double largest_angle = 6.2832;

/// Ratio of knee to hip angle. A ratio of 2 would keep the axle of legs with equal links below the
/// hip. But bent knees move mass forward: at a hip of .455 rad the torso would have to lean back by
/// .066 rad. This is the ratio of `start`'s knee .791 and hip .455, where the centre of mass is
/// above the axle with the torso upright. From there to straight legs the lean is within .025 rad.
inline constexpr double knee_per_hip = 0.791 / 0.455;

/// The command at `time`; null before the first one.
const CrouchCommand* crouch_at(const CrouchScript& script, double time);

/// Describes one command of `script`. When reading, it is the last so far, and must be the latest.
void describe(Fields& fields, CrouchCommand& command, const CrouchScript& script);

/// From `time` on, drives at these velocities.
struct VelocityCommand {
  double time = 0.0;      ///< s
  double velocity = 0.0;  ///< along the ground, forward positive (m/s)
  double yaw_rate = 0.0;  ///< to the left positive (rad/s)
};

/// Piecewise constant driving commands, sorted by time. Before the first one the robot stands.
using VelocityScript = std::vector<VelocityCommand>;

/// The command at `time`.
VelocityCommand command_at(const VelocityScript& script, double time);

/// Gains of the balancer. Errors are target − measurement.
struct WheelBalancerConfig {
  double pitch_stiffness = 32.0;    ///< integral on the pitch error (m/s² per rad)
  double pitch_damping = 5.5;       ///< proportional on the pitch error (m/s per rad)
  double position_stiffness = 1.5;  ///< integral on the position error (1/s²)
  double position_damping = 3.0;    ///< proportional on the position error (1/s)
  double max_velocity = 2.0;        ///< of the commanded ground velocity (m/s)
  double max_integral = 10.0;       ///< of the integral part of that command (m/s)
  double max_acceleration = 1.0;    ///< of the target velocity (m/s²)
  double max_position_error = 1.0;  ///< m
  double air_decay_time = 1.0;      ///< of the integral, without contact (s)
  double wheel_kd_scale = 0.2;      ///< of the wheels' velocity servo
  double yaw_stiffness = 1.0;       ///< differential wheel torque (N·m/rad)
  double yaw_damping = 0.1;         ///< N·m·s/rad
  double lateral_stiffness = 0.5;   ///< heading per metre of lateral error (rad/m)
  double max_lateral_error = 0.6;   ///< m
  bool keep_heading = false;        ///< course: the heading at the reset, not the world's +x
  double leg_kp_scale = 2.0;        ///< of the hips and knees
  double leg_kd_scale = 2.0;        ///< of the hips and knees
};

/// The default gains, tuned for Upkie with bent legs on stairs.
inline WheelBalancerConfig with_touchdown_gains(WheelBalancerConfig config) {
  const WheelBalancerConfig defaults;
  config.pitch_stiffness = defaults.pitch_stiffness;
  config.pitch_damping = defaults.pitch_damping;
  config.position_stiffness = defaults.position_stiffness;
  config.position_damping = defaults.position_damping;
  return config;
}

/// The gains that Upkie ships with (github.com/upkie/upkie, upkie/cpp/controllers/WheelBalancer.h,
/// `WheelBalancer::Parameters`): a third of the default pitch damping, less than a quarter of the
/// default position damping.
inline WheelBalancerConfig with_upkie_gains(WheelBalancerConfig config) {
  config.pitch_stiffness = 20.0;
  config.pitch_damping = 1.8;
  config.position_stiffness = 1.6;
  config.position_damping = 0.7;
  return config;
}

/// Computes gains from the robot's physics (policies/wheeled_pendulum.hpp).
using LqrGains = std::function<WheelBalancerConfig(const WheelBalancerConfig&)>;

/// The key `gains` selects initial values: `upkie` uses `with_upkie_gains`, `touchdown` uses
/// `with_touchdown_gains`, and `lqr` uses the function `lqr`, if one is given. Only the numbers are
/// written.
void describe(Fields& fields, WheelBalancerConfig& config, const LqrGains& lqr = {});
/// Describes one command of `script`. When reading, it is the last so far, and must be the latest.
void describe(Fields& fields, VelocityCommand& command, const VelocityScript& script);

}  // namespace touchdown::policies
