#include "logs/log/row.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <sstream>

namespace touchdown::logs {

namespace {

using Role = LogKey::Role;

constexpr std::array<std::string_view, 3> reading_names = {"position", "velocity", "torque"};
constexpr std::array<std::string_view, 1> joint_truth_names = {"joint_torque"};
constexpr std::array<std::string_view, 6> command_names = {
    "feedforward_torque", "position", "velocity", "kp_scale", "kd_scale", "maximum_torque"};
constexpr std::array<std::string_view, models::wheel_count> sides = {"left", "right"};

void add_servos(std::vector<LogKey>& keys, const std::string& prefix,
                std::span<const std::string_view> names, std::size_t slot, Role role) {
  for (const std::string_view servo : models::servo_names) {
    for (const std::string_view name : names) {
      keys.push_back(
          {prefix + "." + std::string(servo) + "." + std::string(name), slot++, 1, role});
    }
  }
}

void add_readings(std::vector<LogKey>& keys, const std::string& prefix, std::size_t slot,
                  std::size_t most, Role role) {
  for (std::size_t i = 0; i < most; ++i) {
    for (const std::string_view name : reading_names) {
      keys.push_back({prefix + "." + std::to_string(i) + "." + std::string(name), slot++, 1, role});
    }
  }
}

void add_truth(std::vector<LogKey>& keys, const std::string& root, Role role) {
  keys.push_back({root + ".base.position", log_slot::true_position, 3, role});
  keys.push_back({root + ".base.orientation", log_slot::true_orientation, 4, role});
  keys.push_back({root + ".base.linear_velocity", log_slot::true_linear_velocity, 3, role});
  keys.push_back({root + ".base.angular_velocity", log_slot::true_angular_velocity, 3, role});
  keys.push_back({root + ".imu.linear_velocity", log_slot::true_imu_velocity, 3, role});
}

/// Upkie's simulation spines count contact points: per link until 7.0, then per named group.
void add_contact_counts(std::vector<LogKey>& keys, const std::string& root) {
  for (std::size_t side = 0; side < sides.size(); ++side) {
    const std::string wheel = root + ".contact." + std::string(sides[side]) + "_wheel";
    const std::size_t slot = log_slot::contact_points + side;
    keys.push_back({wheel, slot, 1, Role::alias});
    keys.push_back({wheel + ".num_contact_points", slot, 1, Role::alias});
    keys.push_back({wheel + "_tire", slot, 1, Role::alias});
    keys.push_back({wheel + "_tire.num_contact_points", slot, 1, Role::alias});
  }
}

std::vector<LogKey> make_keys() {
  std::vector<LogKey> keys;
  keys.push_back({"time", log_slot::wall_time, 1, Role::optional});
  add_servos(keys, "action.servo", command_names, log_slot::command, Role::optional);
  keys.push_back({"observation.time", log_slot::time, 1, Role::optional});
  add_servos(keys, "observation.servo", reading_names, log_slot::servo, Role::needed);
  const std::string imu = "observation.imu.";
  keys.push_back({imu + "orientation", log_slot::imu_orientation, 4, Role::needed});
  keys.push_back({imu + "angular_velocity", log_slot::angular_velocity, 3, Role::needed});
  keys.push_back({imu + "linear_acceleration", log_slot::linear_acceleration, 3, Role::needed});
  keys.push_back({imu + "raw_angular_velocity", log_slot::raw_angular_velocity, 3});
  keys.push_back({imu + "raw_linear_acceleration", log_slot::raw_acceleration, 3});
  const std::string base = "observation.base_orientation.";
  keys.push_back({base + "pitch", log_slot::pitch, 1});
  keys.push_back({base + "angular_velocity", log_slot::base_angular_velocity, 3});
  keys.push_back({base + "rotation_base_to_world", log_slot::base_to_world, 9});
  keys.push_back({base + "yaw", log_slot::yaw, 1});
  keys.push_back({base + "yaw_rate", log_slot::yaw_rate, 1});
  add_truth(keys, "observation.sim", Role::truth);
  for (std::size_t side = 0; side < sides.size(); ++side) {
    keys.push_back({"observation.sim.contact." + std::string(sides[side]) + "_wheel.normal_force",
                    log_slot::normal_force + side, 1, Role::truth});
  }
  keys.push_back({"observation.sim.contact.body_touches_terrain", log_slot::body_touches_terrain, 1,
                  Role::truth, true});
  add_servos(keys, "observation.sim.servo", joint_truth_names, log_slot::joint_torque,
             Role::joint_truth);
  add_readings(keys, "observation.sim.held", log_slot::held, models::most_held, Role::held_truth);
  add_readings(keys, "observation.motor", log_slot::motor, log_slot::most_motors, Role::motor);
  add_truth(keys, "observation.bullet", Role::alias);
  add_contact_counts(keys, "observation.sim");
  add_contact_counts(keys, "observation.bullet");
  return keys;
}

}  // namespace

const std::vector<LogKey>& log_keys() {
  static const std::vector<LogKey> keys = make_keys();
  return keys;
}

LogKeyTree::LogKeyTree(const std::function<bool(const LogKey&)>& wanted) : nodes_(1) {
  for (const LogKey& key : log_keys()) {
    if (!wanted(key)) continue;
    int at = 0;
    std::stringstream path(key.path);
    for (std::string name; std::getline(path, name, '.');) {
      const std::vector<int>& children = node(at).children;
      const auto found = std::find_if(children.begin(), children.end(),
                                      [&](int child) { return node(child).name == name; });
      if (found != children.end()) {
        at = *found;
        continue;
      }
      const int added = static_cast<int>(nodes_.size());
      nodes_.push_back({name, {}, nullptr});
      nodes_[static_cast<std::size_t>(at)].children.push_back(added);
      at = added;
    }
    nodes_[static_cast<std::size_t>(at)].key = &key;
  }
}

namespace {

/// Attitude of the base according to its IMU. World: x forward, y left, z up.
struct BaseAttitude {
  Eigen::Matrix3d base_to_world = Eigen::Matrix3d::Identity();
  /// In the base frame (rad/s).
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  double pitch = 0.0;       ///< positive when it leans forward (rad)
  double pitch_rate = 0.0;  ///< about the base's own leftward axis (rad/s)
  double yaw = 0.0;         ///< positive to the left (rad)
  double yaw_rate = 0.0;    ///< about the world's vertical (rad/s)
};

/// Computes the attitude from the IMU's orientation (to x forward, y right, z down) and angular
/// velocity, which are in the IMU frame of all recordings (`imu_convention`).
BaseAttitude base_attitude(const models::ImuReading& imu) {
  const Eigen::DiagonalMatrix<double, 3> base_to_imu(-1.0, 1.0, -1.0);
  const Eigen::DiagonalMatrix<double, 3> ars_to_world(1.0, -1.0, -1.0);
  BaseAttitude attitude;
  Eigen::Matrix3d& rotation = attitude.base_to_world;
  rotation = ars_to_world * imu.orientation.normalized().toRotationMatrix() * base_to_imu;
  attitude.angular_velocity = base_to_imu * imu.angular_velocity;
  attitude.pitch = std::asin(std::clamp(-rotation(2, 0), -1.0, 1.0));
  attitude.pitch_rate = attitude.angular_velocity.y();
  attitude.yaw = std::atan2(rotation(1, 0), rotation(0, 0));
  attitude.yaw_rate = rotation.row(2).dot(attitude.angular_velocity);
  return attitude;
}

void put(LogValues& values, std::size_t slot, double number) { values[slot] = number; }

void put(LogValues& values, std::size_t slot, const Eigen::Vector3d& vector) {
  for (int i = 0; i < 3; ++i) values[slot + static_cast<std::size_t>(i)] = vector[i];
}

void put(LogValues& values, std::size_t slot, const Eigen::Quaterniond& q) {
  values[slot] = q.w();
  put(values, slot + 1, Eigen::Vector3d(q.vec()));
}

void take(const LogValues& values, std::size_t slot, double& number) { number = values[slot]; }

void take(const LogValues& values, std::size_t slot, Eigen::Vector3d& vector) {
  vector = {values[slot], values[slot + 1], values[slot + 2]};
}

void take(const LogValues& values, std::size_t slot, Eigen::Quaterniond& q) {
  q = Eigen::Quaterniond(values[slot], values[slot + 1], values[slot + 2], values[slot + 3]);
}

constexpr std::array<double models::ServoCommand::*, 6> command_members = {
    &models::ServoCommand::feedforward_torque, &models::ServoCommand::position,
    &models::ServoCommand::velocity,           &models::ServoCommand::kp_scale,
    &models::ServoCommand::kd_scale,           &models::ServoCommand::maximum_torque};

constexpr std::array<double models::ServoReading::*, 3> reading_members = {
    &models::ServoReading::position, &models::ServoReading::velocity,
    &models::ServoReading::torque};

/// Calls `visit` with the slots and members that every step must have, for writing and reading.
template <typename Readings, typename Visit>
void visit_needed(Readings& observation, const Visit& visit) {
  for (std::size_t servo = 0; servo < models::servo_count; ++servo) {
    for (std::size_t i = 0; i < reading_members.size(); ++i) {
      visit(log_slot::servo + 3 * servo + i, observation.servo[servo].*reading_members[i]);
    }
  }
  visit(log_slot::imu_orientation, observation.imu.orientation);
  visit(log_slot::angular_velocity, observation.imu.angular_velocity);
  visit(log_slot::linear_acceleration, observation.imu.linear_acceleration);
}

/// The same for values that have a default or can be derived.
template <typename Readings, typename Commands, typename Visit>
void visit_optional(Readings& observation, Commands& action, const Visit& visit) {
  for (std::size_t servo = 0; servo < models::servo_count; ++servo) {
    for (std::size_t i = 0; i < command_members.size(); ++i) {
      visit(log_slot::command + 6 * servo + i, action.servo[servo].*command_members[i]);
    }
  }
  visit(log_slot::raw_acceleration, observation.imu.raw_linear_acceleration);
  visit(log_slot::pitch, observation.pitch);
  visit(log_slot::base_angular_velocity + 1, observation.pitch_rate);
  visit(log_slot::yaw, observation.yaw);
  visit(log_slot::yaw_rate, observation.yaw_rate);
}

template <typename Truth, typename Visit>
void visit_truth(Truth& truth, const Visit& visit) {
  visit(log_slot::true_position, truth.base_position);
  visit(log_slot::true_orientation, truth.base_orientation);
  visit(log_slot::true_linear_velocity, truth.base_linear_velocity);
  visit(log_slot::true_angular_velocity, truth.base_angular_velocity);
  visit(log_slot::true_imu_velocity, truth.imu_linear_velocity);
}

template <typename Readings, typename Visit>
void visit_readings(std::size_t slot, Readings& readings, const Visit& visit) {
  for (auto& reading : readings) {
    for (const auto member : reading_members) visit(slot++, reading.*member);
  }
}

std::size_t count_of_readings(const LogPresence& present, std::size_t slot, std::size_t most) {
  std::size_t count = 0;
  while (count < most && present[slot + 3 * count]) ++count;
  return count;
}

double normal_force(const LogValues& values, const LogPresence& present, std::size_t wheel) {
  if (present[log_slot::normal_force + wheel]) return values[log_slot::normal_force + wheel];
  if (!present[log_slot::contact_points + wheel]) return std::numeric_limits<double>::quiet_NaN();
  return values[log_slot::contact_points + wheel] > 0.0 ? std::numeric_limits<double>::infinity()
                                                        : 0.0;
}

}  // namespace

LogValues to_values(const models::Observation& observation, const models::Action& action,
                    const models::GroundTruth* truth) {
  LogValues values{};
  const auto write = [&](std::size_t slot, const auto& member) { put(values, slot, member); };
  write(log_slot::wall_time, observation.time);
  write(log_slot::time, observation.time);
  write(log_slot::raw_angular_velocity, observation.imu.angular_velocity);
  const BaseAttitude attitude = base_attitude(observation.imu);
  write(log_slot::base_angular_velocity, attitude.angular_velocity);
  for (int row = 0; row < 3; ++row) {
    write(log_slot::base_to_world + 3 * static_cast<std::size_t>(row),
          Eigen::Vector3d(attitude.base_to_world.row(row)));
  }
  visit_needed(observation, write);
  visit_optional(observation, action, write);
  visit_readings(log_slot::motor, observation.motor, write);
  if (truth == nullptr) return values;
  visit_truth(*truth, write);
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    write(log_slot::normal_force + wheel, truth->wheel_normal_force[wheel]);
  }
  write(log_slot::body_touches_terrain, truth->body_touches_terrain ? 1.0 : 0.0);
  if (truth->joint_torque) {
    std::copy(truth->joint_torque->begin(), truth->joint_torque->end(),
              values.begin() + log_slot::joint_torque);
  }
  visit_readings(log_slot::held, truth->held, write);
  return values;
}

double time_of(const LogValues& values, const LogPresence& present) {
  return values[present[log_slot::time] ? log_slot::time : log_slot::wall_time];
}

LogRow to_row(const LogValues& values, const LogPresence& present) {
  const auto read = [&](std::size_t slot, auto& member) { take(values, slot, member); };
  LogRow row;
  models::Observation& observation = row.observation;
  observation.time = time_of(values, present);
  visit_needed(observation, read);
  // Proper acceleration is the acceleration minus gravity, which points to the ARS frame's +z.
  observation.imu.raw_linear_acceleration =
      observation.imu.linear_acceleration -
      observation.imu.orientation.conjugate() * Eigen::Vector3d(0.0, 0.0, 9.81);
  const BaseAttitude attitude = base_attitude(observation.imu);
  observation.pitch = attitude.pitch;
  observation.pitch_rate = attitude.pitch_rate;
  observation.yaw = attitude.yaw;
  observation.yaw_rate = attitude.yaw_rate;
  visit_optional(observation, row.action, [&](std::size_t slot, auto& member) {
    if (present[slot]) read(slot, member);
  });
  observation.motor.resize(count_of_readings(present, log_slot::motor, log_slot::most_motors));
  visit_readings(log_slot::motor, observation.motor, read);
  if (!present[log_slot::true_position] || !present[log_slot::true_orientation]) return row;
  models::GroundTruth& truth = row.truth.emplace();
  visit_truth(truth, read);
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    truth.wheel_normal_force[wheel] = normal_force(values, present, wheel);
  }
  truth.body_touches_terrain = values[log_slot::body_touches_terrain] != 0.0;
  if (present[log_slot::joint_torque]) {
    std::copy_n(values.begin() + log_slot::joint_torque, models::servo_count,
                truth.joint_torque.emplace().begin());
  }
  truth.held.resize(count_of_readings(present, log_slot::held, models::most_held));
  visit_readings(log_slot::held, truth.held, read);
  return row;
}

}  // namespace touchdown::logs
