#pragma once

#include <array>

#include <Eigen/Geometry>

#include "models/robot_model.hpp"
#include "policies/commands.hpp"

namespace touchdown::policies {

/// Where the servos of a robot are studied.
struct ServoPose {
  Eigen::Quaterniond orientation;
  std::array<double, models::servo_count> joint_position = {};  ///< rad
  double period = 1e-3;                                         ///< of the physics step (s)
};

/// The factor on all gains at which the servos become unstable, up to 100: above 1 they are stable.
struct ServoMargins {
  double flight = 0.0;
  double standing = 0.0;  ///< both tyres roll without slip
};

/// The margins of the balancer's servos and of held joints, with all joints coupled by the mass
/// matrix and a free or standing base, in the engine where they are less. Torques are held for one
/// physics step, which both engines integrate alike: velocity first (explicitly), then position.
/// The lag of torques, sticking and viscous friction count, and in Bullet its compensation of
/// rotors; gravity and torque limits do not. A command's delay is outside of this loop, because
/// servos measure their joints without delay.
ServoMargins servo_margins(const models::RobotModel& robot, const ServoPose& pose,
                           const WheelBalancerConfig& config);

/// The least margin that derived gains have: a run may draw servos that are 20 % stiffer. Softer
/// legs on nearly straight knees fall after hops.
inline constexpr double least_servo_margin = 1.25;

/// Lowers the servos' gains until both margins hold: first those of legs and of wheels (with
/// yaw's), each on its own, then both. Gains that have the margins stay as they are. Errors:
/// `InputError` if held joints or friction leave no margin.
WheelBalancerConfig with_stable_servos(const WheelBalancerConfig& config,
                                       const models::RobotModel& robot, const ServoPose& pose);

}  // namespace touchdown::policies
