#pragma once

#include <Eigen/Core>

namespace touchdown::odometry {

// SO(3), and SE₂(3): rotation, velocity and position as one group (Barrau and Bonnabel 2017). A
// vector of its algebra is (φ, ν, ρ): a rotation, a velocity, a position. docs/odometry.md has the
// equations.

using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

/// The matrix that crosses with `v`: hat(v) w = v × w.
[[nodiscard]] Eigen::Matrix3d hat(const Eigen::Vector3d& v) noexcept;

/// The rotation about `angle` by its length (rad), and back: the shortest such vector.
[[nodiscard]] Eigen::Matrix3d exp_so3(const Eigen::Vector3d& angle) noexcept;
[[nodiscard]] Eigen::Vector3d log_so3(const Eigen::Matrix3d& rotation) noexcept;

/// J of exp(φ + δ) ≈ exp(J δ) exp(φ), and its inverse, which has no value at a full turn.
[[nodiscard]] Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& angle) noexcept;
[[nodiscard]] Eigen::Matrix3d inverse_left_jacobian(const Eigen::Vector3d& angle) noexcept;

/// An element of SE₂(3): how a body is turned, how fast it moves and where it is, in the world.
struct ExtendedPose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< from the body to the world
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< m/s
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< m
};

[[nodiscard]] ExtendedPose operator*(const ExtendedPose& a, const ExtendedPose& b) noexcept;
[[nodiscard]] ExtendedPose inverse(const ExtendedPose& x) noexcept;
[[nodiscard]] ExtendedPose exp_se23(const Vector9& xi) noexcept;
[[nodiscard]] Vector9 log_se23(const ExtendedPose& x) noexcept;
/// Ad of x exp(ξ) = exp(Ad ξ) x.
[[nodiscard]] Matrix9 adjoint(const ExtendedPose& x) noexcept;

}  // namespace touchdown::odometry
