#pragma once

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "estimator/odometry/lie.hpp"

namespace touchdown::odometry::test {

/// The inverses of `exp_so3`, of an element of SE₂(3) and of `exp_se23`.
inline Eigen::Vector3d log_so3(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);  // via the quaternion: accurate near half a turn, too
  return turn.angle() * turn.axis();
}

inline ExtendedPose inverse(const ExtendedPose& x) {
  const Eigen::Matrix3d back = x.rotation.transpose();
  return {back, -back * x.velocity, -back * x.position};
}

inline Vector9 log_se23(const ExtendedPose& x) {
  Vector9 xi;
  xi.head<3>() = log_so3(x.rotation);
  const Eigen::Matrix3d jacobian = left_jacobian(xi.head<3>()).inverse();
  xi.segment<3>(3) = jacobian * x.velocity;
  xi.tail<3>() = jacobian * x.position;
  return xi;
}

/// Ad of x exp(ξ) = exp(Ad ξ) x.
inline Eigen::Matrix<double, 9, 9> adjoint(const ExtendedPose& x) {
  Eigen::Matrix<double, 9, 9> matrix = Eigen::Matrix<double, 9, 9>::Zero();
  matrix.block<3, 3>(0, 0) = matrix.block<3, 3>(3, 3) = matrix.block<3, 3>(6, 6) = x.rotation;
  matrix.block<3, 3>(3, 0) = hat(x.velocity) * x.rotation;
  matrix.block<3, 3>(6, 0) = hat(x.position) * x.rotation;
  return matrix;
}

}  // namespace touchdown::odometry::test
