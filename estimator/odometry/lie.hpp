#pragma once

#include <Eigen/Core>

namespace touchdown::odometry {

// The groups SO(3) and SE₂(3), which combines rotation, velocity and position (Barrau and Bonnabel
// 2017). A vector of its algebra is (φ, ν, ρ): rotation, velocity, position. Its exponential is
// (exp φ, J ν, J ρ), with the left Jacobian J of φ.

using Vector9 = Eigen::Matrix<double, 9, 1>;

/// The cross product matrix: hat(v) w = v × w.
[[nodiscard]] Eigen::Matrix3d hat(const Eigen::Vector3d& v) noexcept;

/// Rotation about `angle` by its length (rad).
[[nodiscard]] Eigen::Matrix3d exp_so3(const Eigen::Vector3d& angle) noexcept;

/// J of exp(φ + δ) ≈ exp(J δ) exp(φ).
[[nodiscard]] Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& angle) noexcept;

/// An element of SE₂(3): orientation, velocity and position of a body in the world.
struct ExtendedPose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< from the body to the world
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< m/s
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< m
};

[[nodiscard]] ExtendedPose operator*(const ExtendedPose& a, const ExtendedPose& b) noexcept;
[[nodiscard]] ExtendedPose exp_se23(const Vector9& xi) noexcept;

}  // namespace touchdown::odometry
