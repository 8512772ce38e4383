#pragma once

#include <array>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "models/robot.hpp"

namespace touchdown::simulators {

/// One number per joint, in servo order.
using JointTorques = std::array<double, models::servo_count>;

/// The configuration and velocity of the robot: all that an engine needs to start from.
/// World frame: x forward, y left, z up.
struct RobotState {
  /// Origin of the base frame (m).
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  /// From the base frame to the world.
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  /// Velocity of the base frame's origin, in the world (m/s).
  Eigen::Vector3d linear_velocity = Eigen::Vector3d::Zero();
  /// In the world (rad/s).
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  /// Joint angles (rad) and velocities (rad/s), in servo order.
  std::array<double, models::servo_count> joint_position = {};
  std::array<double, models::servo_count> joint_velocity = {};
};

/// A force on the base from outside the robot, held over one control step.
struct ExternalWrench {
  /// Force in the world frame (N).
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  /// Where it pulls, in the base frame (m).
  Eigen::Vector3d point_in_base = Eigen::Vector3d::Zero();
};

/// The torque of `wrench` about a point of the base (base frame, m), in the world frame (N·m).
inline Eigen::Vector3d torque_about(const Eigen::Vector3d& pivot_in_base,
                                    const ExternalWrench& wrench, const RobotState& state) {
  const Eigen::Vector3d lever = state.orientation * (wrench.point_in_base - pivot_in_base);
  return lever.cross(wrench.force);
}

/// What touched what during one physics step.
struct ContactForces {
  /// Normal force on each tyre from the terrain (N).
  std::array<double, models::wheel_count> wheel_normal_force = {0.0, 0.0};
  /// Anything but a tyre touches the terrain.
  bool body_touches_terrain = false;
};

}  // namespace touchdown::simulators
