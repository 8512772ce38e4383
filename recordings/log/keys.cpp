#include "recordings/log/keys.hpp"

#include <algorithm>
#include <span>
#include <sstream>

namespace touchdown::recordings {

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

void add_held_joints(std::vector<LogKey>& keys) {
  std::size_t slot = log_slot::held;
  for (int joint = 0; joint < models::most_held; ++joint) {
    for (const std::string_view name : reading_names) {
      keys.push_back({"observation.sim.held." + std::to_string(joint) + "." + std::string(name),
                      slot++, 1, Role::held_truth});
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
  add_held_joints(keys);
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

}  // namespace touchdown::recordings
