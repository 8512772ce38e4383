#include "estimator/odometry/lie.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace touchdown::odometry {

namespace {

/// Coefficients of hat(φ) and hat(φ)² in exp and its left Jacobian, as functions of the angle.
struct Coefficients {
  double sine;          ///< sin θ / θ
  double cosine;        ///< (1 − cos θ) / θ²
  double angle_excess;  ///< (θ − sin θ) / θ³
};

Coefficients coefficients(double angle) noexcept {
  const double square = angle * angle;
  constexpr double small = 0.05;  // smaller: differences cancel; next series term: 1e-15
  if (angle < small) {
    return {1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0)),
            0.5 - square / 24.0 * (1.0 - square / 30.0 * (1.0 - square / 56.0)),
            1.0 / 6.0 - square / 120.0 * (1.0 - square / 42.0 * (1.0 - square / 72.0))};
  }
  const double half = std::sin(0.5 * angle);
  return {std::sin(angle) / angle, 2.0 * half * half / square,
          (angle - std::sin(angle)) / (square * angle)};
}

}  // namespace

Eigen::Matrix3d hat(const Eigen::Vector3d& v) noexcept {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

Eigen::Matrix3d exp_so3(const Eigen::Vector3d& angle) noexcept {
  const Coefficients c = coefficients(angle.norm());
  const Eigen::Matrix3d cross = hat(angle);
  return Eigen::Matrix3d::Identity() + c.sine * cross + c.cosine * cross * cross;
}

Eigen::Vector3d log_so3(const Eigen::Matrix3d& rotation) noexcept {
  const Eigen::AngleAxisd turn(rotation);  // via the quaternion: accurate near half a turn, too
  return turn.angle() * turn.axis();
}

Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& angle) noexcept {
  const Coefficients c = coefficients(angle.norm());
  const Eigen::Matrix3d cross = hat(angle);
  return Eigen::Matrix3d::Identity() + c.cosine * cross + c.angle_excess * cross * cross;
}

Eigen::Matrix3d inverse_left_jacobian(const Eigen::Vector3d& angle) noexcept {
  const double square = angle.squaredNorm();
  const Coefficients c = coefficients(std::sqrt(square));
  // (1 − (θ/2) cot(θ/2)) / θ² = (½ (1 − cos θ)/θ² − ½ sin θ/θ + …)/…: from the two others.
  const double last = square < 1e-8 ? 1.0 / 12.0 : (1.0 - 0.5 * c.sine / c.cosine) / square;
  const Eigen::Matrix3d cross = hat(angle);
  return Eigen::Matrix3d::Identity() - 0.5 * cross + last * cross * cross;
}

ExtendedPose operator*(const ExtendedPose& a, const ExtendedPose& b) noexcept {
  return {a.rotation * b.rotation, a.rotation * b.velocity + a.velocity,
          a.rotation * b.position + a.position};
}

ExtendedPose inverse(const ExtendedPose& x) noexcept {
  const Eigen::Matrix3d back = x.rotation.transpose();
  return {back, -back * x.velocity, -back * x.position};
}

ExtendedPose exp_se23(const Vector9& xi) noexcept {
  const Eigen::Vector3d angle = xi.head<3>();
  const Eigen::Matrix3d jacobian = left_jacobian(angle);
  return {exp_so3(angle), jacobian * xi.segment<3>(3), jacobian * xi.tail<3>()};
}

Vector9 log_se23(const ExtendedPose& x) noexcept {
  const Eigen::Vector3d angle = log_so3(x.rotation);
  const Eigen::Matrix3d jacobian = inverse_left_jacobian(angle);
  Vector9 xi;
  for (int i = 0; i < 3; ++i) xi[i] = angle[i];
  xi.segment<3>(3) = jacobian * x.velocity;
  xi.tail<3>() = jacobian * x.position;
  return xi;
}

Matrix9 adjoint(const ExtendedPose& x) noexcept {
  Matrix9 matrix = Matrix9::Zero();
  matrix.block<3, 3>(0, 0) = matrix.block<3, 3>(3, 3) = matrix.block<3, 3>(6, 6) = x.rotation;
  matrix.block<3, 3>(3, 0) = hat(x.velocity) * x.rotation;
  matrix.block<3, 3>(6, 0) = hat(x.position) * x.rotation;
  return matrix;
}

}  // namespace touchdown::odometry
