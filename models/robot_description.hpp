#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "models/actuator.hpp"
#include "models/robot.hpp"

namespace touchdown::models {

/// The actuators of both legs' joints of one kind.
struct LegActuators {
  std::optional<Actuator> hip, knee, wheel;
};

/// A robot as a file describes it: an MJCF alone, whose joints may say `frictionloss`, `damping`
/// and `armature`, or a YAML file that says more about one:
///
///     # Upkie with the actuators that it has.
///     mjcf: upkie.xml            # beside this file
///     actuators:                 # of both legs (models/actuator.hpp); others stay as in the MJCF
///       knee: {friction: 0.06, armature: 0.003}
struct RobotDescription {
  std::filesystem::path mjcf;
  LegActuators actuators;

  /// What the file says of a servo's actuator, if anything.
  const std::optional<Actuator>& actuator(Servo servo) const;
};

/// Errors: `InputError` with file:line:column.
RobotDescription robot_description(const std::filesystem::path& file);

/// All that the description depends on, for digests: the text of the file, and of the MJCF it
/// names.
std::string robot_text(const std::filesystem::path& file);

}  // namespace touchdown::models
