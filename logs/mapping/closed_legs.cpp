#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "estimator/record.hpp"
#include "logs/mapping/mapping.hpp"

namespace touchdown::logs {

namespace {

/// What the IMU's chip measures, from the acceleration without gravity (m/s²).
Eigen::Vector3d proper_acceleration(const LogValues& values) {
  const double* const a = &values[log_slot::linear_acceleration];
  const double* const q = &values[log_slot::imu_orientation];
  const Eigen::Vector3d down(0.0, 0.0, gravity_at_rest);  // of a reference with z down
  return Eigen::Vector3d(a[0], a[1], a[2]) -
         Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() * down;
}

}  // namespace

MotorsToLegs::MotorsToLegs(const std::filesystem::path& robot)
    : robot_(models::compile_robot_model(robot, models::Terrain{})) {
  if (!robot_.closed_leg[0]) {
    throw InputError(robot.string() + ": expected a robot with closed legs");
  }
  legs_ = models::closed_legs(robot_);
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

void MotorsToLegs::convert(LogValues& values) {
  std::array<LegSignals, 2> signals;
  double* motor = &values[log_slot::motor];
  for (std::size_t leg = 0; leg < signals.size(); ++leg) {
    double* const joints = &values[log_slot::servo + 9 * leg];
    const MotorLeg& of = legs_.legs()[leg];
    for (std::size_t i = 0; i < of.linkage.motors.size(); ++i, motor += 3) {
      const double* const theirs = joints + 3 * i;
      (i == 0 ? signals[leg].hip : signals[leg].knee) = {theirs[0], theirs[1], theirs[2]};
      motor[0] = of.sign.at(i) * theirs[0] + of.zero.at(i);
      motor[1] = of.sign.at(i) * theirs[1];
      motor[2] = of.sign.at(i) * theirs[2];
    }
    const std::size_t wheel = 3 * leg + 2;
    for (int i = 6; robot_.is_reversed[wheel] && i < 9; ++i) joints[i] = -joints[i];
    joints[6] += robot_.zero[wheel];
  }
  legs_.convert(signals, proper_acceleration(values));
  for (std::size_t leg = 0; leg < signals.size(); ++leg) {
    double* joints = &values[log_slot::servo + 9 * leg];
    for (const JointSignals& joint : {signals[leg].hip, signals[leg].knee}) {
      *joints++ = joint.position;
      *joints++ = joint.velocity;
      *joints++ = joint.torque;
    }
  }
}

}  // namespace touchdown::logs
