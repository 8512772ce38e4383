#pragma once

#include <vector>

#include "core/yaml.hpp"

namespace touchdown {

/// From `time` on, drive at these velocities.
struct VelocityCommand {
  double time = 0.0;      ///< s
  double velocity = 0.0;  ///< along the ground, forward positive (m/s)
  double yaw_rate = 0.0;  ///< to the left positive (rad/s)
};

/// What a driver would do with the sticks: piecewise constant commands, sorted by time. Before the
/// first one the robot stands.
using VelocityScript = std::vector<VelocityCommand>;

/// The command in force at `time`.
VelocityCommand command_at(const VelocityScript& script, double time);

/// A list of `{time, velocity, yaw_rate}`. Errors: `InputError`, also for times out of order.
VelocityScript velocity_script_from_yaml(YamlMap& parent, std::string_view key);
YAML::Node to_yaml(const VelocityScript& script);

}  // namespace touchdown
