#include "logs/mapping/closed_legs.hpp"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "estimator/record.hpp"

namespace touchdown::logs {

namespace {

/// The specific force in the base frame (m/s²), from the IMU's axes: back, left, down.
Eigen::Vector3d specific_force(const LogValues& values) {
  const auto at = [&](std::size_t slot) {
    return Eigen::Vector3d(values[slot], values[slot + 1], values[slot + 2]);
  };
  const double* const q = &values[log_slot::imu_orientation];
  const Eigen::Vector3d down(0.0, 0.0, gravity_at_rest);  // of a reference with z down
  const Eigen::Vector3d gravity = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() * down;
  return Eigen::Vector3d(-1.0, 1.0, -1.0).cwiseProduct(at(log_slot::linear_acceleration) - gravity);
}

}  // namespace

MotorsToLegs::MotorsToLegs(const std::filesystem::path& robot)
    : robot_(models::compile_robot_model(robot, models::Terrain{})) {
  if (!robot_.closed_leg[0]) {
    throw InputError(robot.string() + ": expected a robot with closed legs");
  }
  for (std::size_t leg = 0; leg < angles_.size(); ++leg) {
    angles_[leg] = robot_.closed_leg[leg]->linkage.start;
  }
}

std::size_t MotorsToLegs::motors_per_leg() const {
  return robot_.closed_leg[0]->linkage.motors.size();
}

std::string MotorsToLegs::joints() const {
  std::vector<std::string> names;
  for (std::size_t servo = 0; servo < models::servo_count; ++servo) {
    if (robot_.motor_joint[servo] >= 0) names.push_back(models::motor_name(robot_, servo));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

namespace {

/// Position, velocity and torque of a joint with the sign and the zero of the robot's file, in
/// touchdown's.
void to_touchdown(double* reported, bool is_reversed, double zero) {
  for (int i = 0; is_reversed && i < 3; ++i) reported[i] = -reported[i];
  reported[0] += zero;
}

}  // namespace

void MotorsToLegs::convert(LogValues& values) {
  const Eigen::Vector3d force = specific_force(values);
  double* motor = &values[log_slot::motor];
  for (std::size_t leg = 0; leg < angles_.size(); ++leg) {
    const models::Linkage& linkage = robot_.closed_leg[leg]->linkage;
    const std::size_t count = linkage.motors.size();
    double* const joints = &values[log_slot::servo + 9 * leg];
    to_touchdown(joints + 6, robot_.is_reversed[3 * leg + 2], robot_.zero[3 * leg + 2]);
    std::array<double, 2> at = {};
    models::LinkageVector rates(static_cast<Eigen::Index>(count));
    models::LinkageVector torques(static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < count; ++i, motor += 3) {
      std::copy_n(joints + 3 * i, 3, motor);
      const auto hinge = static_cast<std::size_t>(linkage.motors[i]);
      const std::size_t servo = 3 * leg + hinge;
      if (hinge < 2) to_touchdown(motor, robot_.is_reversed[servo], robot_.zero[servo]);
      at.at(i) = motor[0];
      rates[static_cast<Eigen::Index>(i)] = motor[1];
      torques[static_cast<Eigen::Index>(i)] = motor[2];
    }
    std::fill_n(joints, 6, std::numeric_limits<double>::quiet_NaN());
    const std::span<const double> angles(at.data(), count);
    models::LinkageVector q = angles_[leg];
    const bool are_known = std::all_of(angles.begin(), angles.end(),
                                       [](double angle) { return std::isfinite(angle); });
    if (!are_known || !move_linkage(linkage, linkage.motors, angles, q)) continue;
    angles_[leg] = q;
    const models::MotorMap map(linkage, q);
    const Eigen::Vector2d leg_rates = map.leg * rates;
    const Eigen::Vector2d leg_torques = map.leg_torques(torques, {force.x(), force.z()});
    for (Eigen::Index i = 0; i < 2; ++i) {
      joints[3 * i] = q[i];
      joints[3 * i + 1] = leg_rates[i];
      joints[3 * i + 2] = leg_torques[i];
    }
  }
}

}  // namespace touchdown::logs
