#pragma once

#include <array>

#include <Eigen/Core>

namespace touchdown::odometry {

/// Joint measurements of one leg with the signs of its servos: hip, knee, wheel.
struct LegJoints {
  std::array<double, 3> position = {};  ///< rad
  std::array<double, 3> velocity = {};  ///< rad/s
};

/// Geometry of one leg with all joints at zero, in the axes of the base: x forward, y left, z up.
/// The joints turn about ±y.
struct WheeledLeg {
  Eigen::Vector3d hip;    ///< from the IMU to the hip axis, in the plane of the tyre (m)
  Eigen::Vector3d upper;  ///< from the hip to the knee, in that plane (m)
  Eigen::Vector3d lower;  ///< from the knee to the wheel's centre (m)
  std::array<double, 3> turn = {1.0, 1.0, 1.0};  ///< +1: joint turns about +y; −1: about −y
};

/// Geometry of a wheeled biped.
struct WheeledBiped {
  Eigen::Matrix3d imu_in_base;    ///< rotation from the axes of the IMU to those of the base
  std::array<WheeledLeg, 2> leg;  ///< left, right
  double wheel_radius = 0.05;     ///< m
};

/// The geometry of Upkie. The axes of its IMU point back, left and down.
[[nodiscard]] WheeledBiped upkie() noexcept;

/// Motion of a wheel relative to the base: position (m, from the IMU) and velocity (m/s) of its
/// centre, and spin about y (rad/s).
struct WheelMotion {
  Eigen::Vector3d centre;
  Eigen::Vector3d velocity;
  double spin = 0.0;
};

[[nodiscard]] WheelMotion motion_of(const WheeledLeg& leg, const LegJoints& joints) noexcept;

}  // namespace touchdown::odometry
