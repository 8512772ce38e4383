#pragma once

#include <Eigen/Core>

#include "models/robot.hpp"

namespace touchdown::recordings {

/// Attitude of the base as its IMU tells it. World: x forward, y left, z up.
struct BaseAttitude {
  Eigen::Matrix3d base_to_world = Eigen::Matrix3d::Identity();
  /// In the base frame (rad/s).
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  double pitch = 0.0;       ///< positive when it leans forward (rad)
  double pitch_rate = 0.0;  ///< about the base's own leftward axis (rad/s)
  double yaw = 0.0;         ///< positive to the left (rad)
  double yaw_rate = 0.0;    ///< about the world's vertical (rad/s)
};

/// From the IMU's orientation (to x forward, y right, z down) and angular velocity, with the IMU
/// mounted as on Upkie: x back, y left, z down.
BaseAttitude base_attitude(const models::ImuReading& imu);

}  // namespace touchdown::recordings
