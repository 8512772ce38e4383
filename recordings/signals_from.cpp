#include "recordings/signals_from.hpp"

namespace touchdown::recordings {

double ground_velocity_command(const models::Action& action, double wheel_radius) {
  const double left = action.servo[models::index(models::Servo::left_wheel)].velocity;
  const double right = action.servo[models::index(models::Servo::right_wheel)].velocity;
  return 0.5 * wheel_radius * (left - right);
}

RobotRecord record_of(const models::Observation& observation,
                      double previous_ground_velocity_command, RecordedJoints& joints) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const models::ServoReading& reading = observation.servo[i];
    joints[i] = {reading.position, reading.velocity, reading.torque};
  }
  const models::ImuReading& imu = observation.imu;
  const Eigen::Quaterniond& q = imu.orientation;
  // Older logs lack it.
  Eigen::Vector3d proper = imu.raw_linear_acceleration;
  if (proper.isZero(0.0)) proper.setConstant(not_reported);
  return {.time = observation.time,
          .joints = joints,
          .orientation = {q.w(), q.x(), q.y(), q.z()},
          .angular_velocity = imu.angular_velocity,
          .linear_acceleration = imu.linear_acceleration,
          .proper_acceleration = proper,
          .ground_velocity_command = previous_ground_velocity_command};
}

Signals signals_from(const models::Observation& observation,
                     double previous_ground_velocity_command) {
  RecordedJoints joints;
  static const AssemblyConfig upkie;
  return signals_of(record_of(observation, previous_ground_velocity_command, joints), upkie);
}

}  // namespace touchdown::recordings
