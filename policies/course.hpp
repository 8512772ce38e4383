#pragma once

#include <array>
#include <memory>

#include "models/robot.hpp"
#include "policies/commands.hpp"

namespace touchdown::policies {

/// The driving and crouch commands of a run.
struct CourseScripts {
  VelocityScript velocity;
  CrouchScript crouch;
};

/// The common part of the balancing laws: targets of position, speed and crouch from the scripts,
/// and the robot's position from wheel odometry.
struct Course {
  /// Never null. Its owner may add commands during the run.
  std::shared_ptr<const CourseScripts> scripts = std::make_shared<CourseScripts>();
  double wheel_radius = 0.05;  ///< m
  double period = 1e-3;        ///< of the control loop (s)

  std::array<double, models::servo_count> posture = {};  ///< of the joints (rad)
  double target_velocity = 0.0;                          ///< m/s
  double target_position = 0.0;                          ///< m
  double target_yaw = 0.0;                               ///< rad
  double position = 0.0;                                 ///< along the ground, by odometry (m)
  double lateral = 0.0;  ///< to the left of the target heading, by odometry (m)
  double heading = 0.0;  ///< unwrapped yaw (rad)
  double last_distance = 0.0;
  double last_yaw = 0.0;

  /// Starts at the robot's current pose.
  void begin(const models::Observation& observation, const WheelBalancerConfig& config);
  /// Advances by one control step.
  void follow(const models::Observation& observation, const WheelBalancerConfig& config);
  /// The raw torque on both wheels that turns the robot towards its course (N·m).
  double yaw_torque(const models::Observation& observation,
                    const WheelBalancerConfig& config) const;
  /// Distance along the ground (m) and speed (m/s) by the wheels' encoders.
  double rolled_distance(const models::Observation& observation) const;
  double rolling_speed(const models::Observation& observation) const;
};

/// The wheel commands of both laws: a ground velocity (m/s), and a raw torque on each wheel (N·m).
void command_wheels(double ground_velocity, const std::array<double, models::wheel_count>& torque,
                    double wheel_radius, const WheelBalancerConfig& config, models::Action& action);

}  // namespace touchdown::policies
