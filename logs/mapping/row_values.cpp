#include "logs/mapping/row_values.hpp"

#include <algorithm>
#include <array>

#include "estimator/record.hpp"
#include "logs/sample_times.hpp"

namespace touchdown::logs {

namespace {

Eigen::Vector3d vector_of(const MappedSignal& signal, std::span<const double> row) {
  return {signal.value(row, 0), signal.value(row, 1), signal.value(row, 2)};
}

/// The IMU of a row, in Upkie's frames.
ImuSignals imu_of(const LogMapping& mapping, std::span<const double> row) {
  RobotRecord record{.angular_velocity = vector_of(mapping.angular_velocity, row)};
  for (std::size_t i = 0; i < 4; ++i) {
    record.orientation.at(mapping.is_w_last ? (i + 1) % 4 : i) = mapping.orientation.value(row, i);
  }
  if (mapping.linear_acceleration) {
    record.linear_acceleration = vector_of(*mapping.linear_acceleration, row);
  }
  if (mapping.proper_acceleration) {
    record.proper_acceleration = vector_of(*mapping.proper_acceleration, row);
  }
  return touchdown::imu_of(record, mapping.conventions);
}

void put(LogValues& values, std::size_t slot, const Eigen::Vector3d& vector) {
  std::copy(vector.begin(), vector.end(), values.begin() + static_cast<std::ptrdiff_t>(slot));
}

constexpr std::array<models::Servo, 4> leg_servos = {
    models::Servo::left_hip, models::Servo::left_knee, models::Servo::right_hip,
    models::Servo::right_knee};

/// The slots of a servo's feed-forward torque, position, velocity and scales of its gains.
constexpr std::size_t command_of(models::Servo servo) {
  return log_slot::command + 6 * models::index(servo);
}
constexpr std::size_t leg_command_size = 5;
constexpr std::size_t velocity_target(models::Servo wheel) { return command_of(wheel) + 2; }

void put_leg_targets(const MappedLegTargets& targets, std::span<const double> row,
                     LogValues& values) {
  for (std::size_t i = 0; i < leg_servos.size(); ++i) {
    double* const command = values.data() + command_of(leg_servos[i]);
    command[0] = targets.torque ? targets.torque->value(row, i) : 0.0;
    command[1] = targets.position.value(row, i);
    command[2] = targets.velocity ? targets.velocity->value(row, i) : 0.0;
    command[3] = targets.kp[i] / models::servo_kp;
    command[4] = targets.kd[i] / models::servo_kd;
  }
}

}  // namespace

std::int64_t SourceClock::stamp(std::span<const double> row) const {
  const MappedSignal::Number& number = time.numbers.front();
  const double rounded = at(row);
  if (!rest || number.sign != 1.0 || number.scale != 1.0 || nanoseconds(rounded) == 0) {
    return nanoseconds(rounded);
  }
  const auto unit = static_cast<double>(std::llround(1e9 * time.unit));  // ns
  const double whole = std::trunc(row[number.column]);
  return static_cast<std::int64_t>(whole) * static_cast<std::int64_t>(unit) +
         std::llround(unit * (row[number.column] - whole + row[*rest])) +
         (nanosec ? std::llround(nanosec->value(row, 0)) : 0);
}

LogValues log_values(const LogMapping& mapping, std::uint64_t k, std::span<const double> row) {
  LogValues values{};
  values[log_slot::time] =
      mapping.time ? mapping.time->at(row) : static_cast<double>(k) * mapping.period;
  for (std::size_t servo = 0; servo < models::servo_count; ++servo) {
    const std::size_t slot = log_slot::servo + 3 * servo;
    values[slot] = mapping.position.value(row, servo);
    values[slot + 1] = mapping.velocity.value(row, servo);
    values[slot + 2] = mapping.torque.value(row, servo);
  }
  const ImuSignals imu = imu_of(mapping, row);
  std::ranges::copy(imu.orientation, values.begin() + log_slot::imu_orientation);
  put(values, log_slot::angular_velocity, imu.angular_velocity);
  put(values, log_slot::linear_acceleration, imu.linear_acceleration);
  if (mapping.proper_acceleration) put(values, log_slot::raw_acceleration, imu.proper_acceleration);
  if (mapping.wheel_velocity_target) {
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      values[velocity_target(models::wheel_servos[wheel])] =
          mapping.wheel_velocity_target->value(row, wheel);
    }
  }
  if (mapping.leg_targets) put_leg_targets(*mapping.leg_targets, row, values);
  if (mapping.closed_legs) mapping.closed_legs->convert(values);
  return values;
}

LogPresence log_presence(const LogMapping& mapping) {
  LogPresence present;
  present.set(log_slot::time);
  for (std::size_t slot = log_slot::servo; slot < log_slot::raw_angular_velocity; ++slot) {
    present.set(slot);
  }
  if (mapping.proper_acceleration) present.set(log_slot::raw_acceleration);
  const std::size_t motors =
      mapping.closed_legs ? models::wheel_count * mapping.closed_legs->motors_per_leg() : 0;
  for (std::size_t i = 0; i < 3 * motors; ++i) present.set(log_slot::motor + i);
  if (mapping.wheel_velocity_target) {
    for (const models::Servo wheel : models::wheel_servos) present.set(velocity_target(wheel));
  }
  if (mapping.leg_targets) {
    for (const models::Servo servo : leg_servos) {
      for (std::size_t i = 0; i < leg_command_size; ++i) present.set(command_of(servo) + i);
    }
  }
  return present;
}

}  // namespace touchdown::logs
