#pragma once

#include <array>

#include <Eigen/Core>

namespace touchdown::odometry {

/// What the servos of one leg report, in their own signs: hip, knee, wheel.
struct LegJoints {
  std::array<double, 3> position = {};  ///< rad
  std::array<double, 3> velocity = {};  ///< rad/s
};

/// One leg in the axes of the base, x forward, y left, z up, with all joints at zero. Its joints
/// turn about ±y.
struct WheeledLeg {
  Eigen::Vector3d hip;    ///< from the IMU to the hip, beside the middle of the tyre (m)
  Eigen::Vector3d upper;  ///< from there to the knee, in the leg's plane (m)
  Eigen::Vector3d lower;  ///< from there to the wheel's centre (m)
  std::array<double, 3> turn = {1.0, 1.0, 1.0};  ///< +1 for a joint that turns about +y, else −1
};

/// A wheeled biped as odometry knows it.
struct WheeledBiped {
  Eigen::Matrix3d imu_in_base;    ///< from the axes of the IMU to those of the base
  std::array<WheeledLeg, 2> leg;  ///< left, right
  double wheel_radius = 0.05;     ///< m
};

/// Upkie: its IMU looks back and down.
[[nodiscard]] WheeledBiped upkie() noexcept;

/// How a wheel moves in the base: its centre, from the IMU (m) and how fast (m/s), and how fast it
/// turns about y (rad/s).
struct WheelMotion {
  Eigen::Vector3d centre;
  Eigen::Vector3d velocity;
  double spin = 0.0;
};

[[nodiscard]] WheelMotion motion_of(const WheeledLeg& leg, const LegJoints& joints) noexcept;

}  // namespace touchdown::odometry
