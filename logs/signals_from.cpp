#include "logs/signals_from.hpp"

namespace touchdown::logs {

double ground_velocity_command(const models::Action& action, double wheel_radius) {
  const double left = action.servo[models::index(models::Servo::left_wheel)].velocity;
  const double right = action.servo[models::index(models::Servo::right_wheel)].velocity;
  return 0.5 * wheel_radius * (left - right);
}

RobotRecord record_of(const models::Observation& observation, const models::Action* previous,
                      RecordedJoints& storage) {
  for (std::size_t i = 0; i < storage.joints.size(); ++i) {
    const models::ServoReading& reading = observation.servo[i];
    storage.joints[i] = {reading.position, reading.velocity, reading.torque};
    if (previous == nullptr) continue;
    const models::ServoCommand& command = previous->servo[i];
    storage.targets[i] = {command.position, command.velocity, command.feedforward_torque,
                          models::servo_kp * command.kp_scale, models::servo_kd * command.kd_scale};
  }
  const models::ImuReading& imu = observation.imu;
  const Eigen::Quaterniond& q = imu.orientation;
  // Older logs lack it.
  Eigen::Vector3d proper = imu.raw_linear_acceleration;
  if (proper.isZero(0.0)) proper.setConstant(not_reported);
  RobotRecord record = {.time = observation.time,
                        .joints = storage.joints,
                        .orientation = {q.w(), q.x(), q.y(), q.z()},
                        .angular_velocity = imu.angular_velocity,
                        .linear_acceleration = imu.linear_acceleration,
                        .proper_acceleration = proper};
  if (previous == nullptr) return record;
  record.ground_velocity_command = ground_velocity_command(*previous);
  record.targets = storage.targets;
  return record;
}

Signals signals_from(const models::Observation& observation, const models::Action* previous) {
  RecordedJoints storage;
  static const AssemblyConfig upkie;
  return signals_of(record_of(observation, previous, storage), upkie);
}

Signals signals_from(const models::Observation& observation,
                     double previous_ground_velocity_command) {
  Signals signals = signals_from(observation, nullptr);
  signals.ground_velocity_command = previous_ground_velocity_command;
  return signals;
}

void StepSignals::reset() {
  assembler_.reset();
  previous_.reset();
}

const Signals& StepSignals::next(const models::Observation& observation,
                                 const models::Action& action) {
  const Signals& signals =
      assembler_.assemble(record_of(observation, previous_ ? &*previous_ : nullptr, joints_));
  previous_ = action;
  return signals;
}

}  // namespace touchdown::logs
