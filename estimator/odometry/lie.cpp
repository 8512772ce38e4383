#include "estimator/odometry/lie.hpp"

#include <cmath>

#include <Eigen/Core>

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

Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& angle) noexcept {
  const Coefficients c = coefficients(angle.norm());
  const Eigen::Matrix3d cross = hat(angle);
  return Eigen::Matrix3d::Identity() + c.cosine * cross + c.angle_excess * cross * cross;
}

ExtendedPose operator*(const ExtendedPose& a, const ExtendedPose& b) noexcept {
  return {a.rotation * b.rotation, a.rotation * b.velocity + a.velocity,
          a.rotation * b.position + a.position};
}

ExtendedPose exp_se23(const Vector9& xi) noexcept {
  const Eigen::Vector3d angle = xi.head<3>();
  const Eigen::Matrix3d jacobian = left_jacobian(angle);
  return {exp_so3(angle), jacobian * xi.segment<3>(3), jacobian * xi.tail<3>()};
}

}  // namespace touchdown::odometry
