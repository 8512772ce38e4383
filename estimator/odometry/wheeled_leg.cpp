#include "estimator/odometry/wheeled_leg.hpp"

#include <cmath>

namespace touchdown::odometry {

namespace {

/// Rotates `v` about y.
Eigen::Vector3d turned(double angle, const Eigen::Vector3d& v) noexcept {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() + s * v.z(), v.y(), c * v.z() - s * v.x()};
}

/// Velocity of the point `v` in a rotation about y.
Eigen::Vector3d turning(double rate, const Eigen::Vector3d& v) noexcept {
  return {rate * v.z(), 0.0, -rate * v.x()};
}

}  // namespace

WheeledBiped upkie() noexcept {
  constexpr double to_tyre = 0.1142 + 0.0962 - 0.012 - 0.046;  // sideways, from the middle
  WheeledBiped robot;
  robot.imu_in_base = Eigen::Vector3d(-1.0, 1.0, -1.0).asDiagonal();
  robot.leg[0] = {{0.0, to_tyre, -0.064}, {0.0, 0.0, -0.168}, {0.0, 0.0, -0.175}, {-1, -1, 1}};
  robot.leg[1] = {{0.0, -to_tyre, -0.064}, {0.0, 0.0, -0.168}, {0.0, 0.0, -0.175}, {1, 1, -1}};
  return robot;
}

WheelMotion motion_of(const WheeledLeg& leg, const LegJoints& joints) noexcept {
  const double hip_rate = leg.turn[0] * joints.velocity[0];
  const double knee_rate = hip_rate + leg.turn[1] * joints.velocity[1];
  const double hip = leg.turn[0] * joints.position[0];
  const Eigen::Vector3d upper = turned(hip, leg.upper);
  const Eigen::Vector3d lower = turned(hip + leg.turn[1] * joints.position[1], leg.lower);
  return {leg.hip + upper + lower, turning(hip_rate, upper) + turning(knee_rate, lower),
          knee_rate + leg.turn[2] * joints.velocity[2]};
}

}  // namespace touchdown::odometry
