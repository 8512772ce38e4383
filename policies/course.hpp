#pragma once

#include <array>

#include "models/robot.hpp"
#include "policies/crouching.hpp"
#include "policies/driving.hpp"

namespace touchdown::policies {

/// Where a robot is asked to be, how fast and how crouched, by its scripts, and where it thinks it
/// is, by its wheels' odometry: what balancing laws have in common.
struct Course {
  VelocityScript script;
  CrouchScript crouch;
  double wheel_radius = 0.05;  ///< m
  double period = 1e-3;        ///< of the control loop (s)

  std::array<double, models::servo_count> posture = {};  ///< of the joints (rad)
  double target_velocity = 0.0;                          ///< m/s
  double target_position = 0.0;                          ///< m
  double target_yaw = 0.0;                               ///< rad
  double position = 0.0;                                 ///< along the ground, by odometry (m)
  double lateral = 0.0;  ///< to the left of the target heading, by odometry (m)
  double heading = 0.0;  ///< yaw without its jumps by 2π (rad)
  double last_distance = 0.0;
  double last_yaw = 0.0;

  /// Begins where the robot stands.
  void begin(const models::Observation& observation, const WheelBalancerConfig& config);
  /// One control step further.
  void follow(const models::Observation& observation, const WheelBalancerConfig& config);
  /// The torque on both wheels, raw, that turns the robot to its course (N·m).
  double yaw_torque(const models::Observation& observation,
                    const WheelBalancerConfig& config) const;
  /// How far the wheels' encoders have gone along the ground (m), and how fast they go (m/s).
  double rolled_distance(const models::Observation& observation) const;
  double rolling_speed(const models::Observation& observation) const;
};

/// What both laws tell the wheels: a ground velocity (m/s), and a raw torque on each (N·m).
void command_wheels(double ground_velocity, const std::array<double, models::wheel_count>& torque,
                    double wheel_radius, const WheelBalancerConfig& config, models::Action& action);

}  // namespace touchdown::policies
