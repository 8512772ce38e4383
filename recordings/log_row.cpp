#include "recordings/log_row.hpp"

#include <limits>

#include "recordings/base_attitude.hpp"

namespace touchdown {

namespace {

void put(LogValues& values, std::size_t slot, const Eigen::Vector3d& vector) {
  for (int i = 0; i < 3; ++i) values[slot + static_cast<std::size_t>(i)] = vector[i];
}

void put(LogValues& values, std::size_t slot, const Eigen::Quaterniond& q) {
  values[slot] = q.w();
  values[slot + 1] = q.x();
  values[slot + 2] = q.y();
  values[slot + 3] = q.z();
}

Eigen::Vector3d vector_at(const LogValues& values, std::size_t slot) {
  return {values[slot], values[slot + 1], values[slot + 2]};
}

Eigen::Quaterniond quaternion_at(const LogValues& values, std::size_t slot) {
  return {values[slot], values[slot + 1], values[slot + 2], values[slot + 3]};
}

constexpr std::array<double ServoCommand::*, 6> command_members = {
    &ServoCommand::feedforward_torque, &ServoCommand::position, &ServoCommand::velocity,
    &ServoCommand::kp_scale,           &ServoCommand::kd_scale, &ServoCommand::maximum_torque};

constexpr std::array<double ServoReading::*, 3> reading_members = {
    &ServoReading::position, &ServoReading::velocity, &ServoReading::torque};

void put_base(LogValues& values, const Observation& observation) {
  const BaseAttitude attitude = base_attitude(observation.imu);
  put(values, log_slot::base_angular_velocity, attitude.angular_velocity);
  for (int i = 0; i < 9; ++i) {
    values[log_slot::base_to_world + static_cast<std::size_t>(i)] =
        attitude.base_to_world(i / 3, i % 3);
  }
  values[log_slot::pitch] = observation.pitch;
  values[log_slot::base_angular_velocity + 1] = observation.pitch_rate;
  values[log_slot::yaw] = observation.yaw;
  values[log_slot::yaw_rate] = observation.yaw_rate;
}

void put_truth(LogValues& values, const GroundTruth& truth) {
  put(values, log_slot::true_position, truth.base_position);
  put(values, log_slot::true_orientation, truth.base_orientation);
  put(values, log_slot::true_linear_velocity, truth.base_linear_velocity);
  put(values, log_slot::true_angular_velocity, truth.base_angular_velocity);
  put(values, log_slot::true_imu_velocity, truth.imu_linear_velocity);
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    values[log_slot::normal_force + wheel] = truth.wheel_normal_force[wheel];
  }
  values[log_slot::body_touches_terrain] = truth.body_touches_terrain ? 1.0 : 0.0;
}

void take_base(Observation& observation, const LogValues& values, const LogPresence& present) {
  const BaseAttitude attitude = base_attitude(observation.imu);
  const auto take = [&](std::size_t slot, double otherwise) {
    return present[slot] ? values[slot] : otherwise;
  };
  observation.pitch = take(log_slot::pitch, attitude.pitch);
  observation.pitch_rate = take(log_slot::base_angular_velocity + 1, attitude.pitch_rate);
  observation.yaw = take(log_slot::yaw, attitude.yaw);
  observation.yaw_rate = take(log_slot::yaw_rate, attitude.yaw_rate);
}

double normal_force(const LogValues& values, const LogPresence& present, std::size_t wheel) {
  if (present[log_slot::normal_force + wheel]) return values[log_slot::normal_force + wheel];
  if (!present[log_slot::contact_points + wheel]) return std::numeric_limits<double>::quiet_NaN();
  return values[log_slot::contact_points + wheel] > 0.0 ? std::numeric_limits<double>::infinity()
                                                        : 0.0;
}

std::optional<GroundTruth> take_truth(const LogValues& values, const LogPresence& present) {
  if (!present[log_slot::true_position] || !present[log_slot::true_orientation]) return {};
  GroundTruth truth;
  truth.base_position = vector_at(values, log_slot::true_position);
  truth.base_orientation = quaternion_at(values, log_slot::true_orientation);
  truth.base_linear_velocity = vector_at(values, log_slot::true_linear_velocity);
  truth.base_angular_velocity = vector_at(values, log_slot::true_angular_velocity);
  truth.imu_linear_velocity = vector_at(values, log_slot::true_imu_velocity);
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    truth.wheel_normal_force[wheel] = normal_force(values, present, wheel);
  }
  truth.body_touches_terrain = values[log_slot::body_touches_terrain] != 0.0;
  return truth;
}

}  // namespace

LogValues to_values(const Observation& observation, const Action& action,
                    const GroundTruth* truth) {
  LogValues values{};
  values[log_slot::wall_time] = observation.time;
  values[log_slot::time] = observation.time;
  for (std::size_t servo = 0; servo < servo_count; ++servo) {
    for (std::size_t i = 0; i < reading_members.size(); ++i) {
      values[log_slot::servo + 3 * servo + i] = observation.servo[servo].*reading_members[i];
    }
    for (std::size_t i = 0; i < command_members.size(); ++i) {
      values[log_slot::command + 6 * servo + i] = action.servo[servo].*command_members[i];
    }
  }
  put(values, log_slot::imu_orientation, observation.imu.orientation);
  put(values, log_slot::angular_velocity, observation.imu.angular_velocity);
  put(values, log_slot::linear_acceleration, observation.imu.linear_acceleration);
  put(values, log_slot::raw_angular_velocity, observation.imu.angular_velocity);
  put(values, log_slot::raw_acceleration, observation.imu.raw_linear_acceleration);
  put_base(values, observation);
  if (truth != nullptr) put_truth(values, *truth);
  return values;
}

LogRow to_row(const LogValues& values, const LogPresence& present) {
  LogRow row;
  Observation& observation = row.observation;
  observation.time = values[present[log_slot::time] ? log_slot::time : log_slot::wall_time];
  for (std::size_t servo = 0; servo < servo_count; ++servo) {
    for (std::size_t i = 0; i < reading_members.size(); ++i) {
      observation.servo[servo].*reading_members[i] = values[log_slot::servo + 3 * servo + i];
    }
    for (std::size_t i = 0; i < command_members.size(); ++i) {
      const std::size_t slot = log_slot::command + 6 * servo + i;
      if (present[slot]) row.action.servo[servo].*command_members[i] = values[slot];
    }
  }
  observation.imu.orientation = quaternion_at(values, log_slot::imu_orientation);
  observation.imu.angular_velocity = vector_at(values, log_slot::angular_velocity);
  observation.imu.linear_acceleration = vector_at(values, log_slot::linear_acceleration);
  if (present[log_slot::raw_acceleration]) {
    observation.imu.raw_linear_acceleration = vector_at(values, log_slot::raw_acceleration);
  } else {
    // Proper acceleration is the acceleration minus gravity, which points to the ARS frame's +z.
    observation.imu.raw_linear_acceleration =
        observation.imu.linear_acceleration -
        observation.imu.orientation.conjugate() * Eigen::Vector3d(0.0, 0.0, 9.81);
  }
  take_base(observation, values, present);
  row.truth = take_truth(values, present);
  return row;
}

}  // namespace touchdown
