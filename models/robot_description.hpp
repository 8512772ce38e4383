#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "models/actuator.hpp"
#include "models/robot.hpp"
#include "models/tyre.hpp"

namespace touchdown::models {

/// The actuators of both legs' joints of one kind.
struct LegActuators {
  std::optional<Actuator> hip, knee, wheel;
};

/// How long legs are, as factors on both links of a leg. What one leg says comes on top of what
/// both do: a difference between the legs as it was manufactured, the same in every run.
struct LegLengths {
  double both = 1.0;
  std::array<double, 2> one = {1.0, 1.0};  ///< left, right
};

/// How bent the legs are when a scenario does not say (rad).
struct Stance {
  double hip = 0.455;
  double knee = 0.791;
};

/// A robot as a file describes it: an MJCF alone, whose joints may say `frictionloss`, `damping`
/// and `armature`, or a YAML file that says more about one:
///
///     # Upkie with a load, on large wheels and long legs, the left one by 3 % the longer.
///     mjcf: upkie.xml            # beside this file
///     mass: 1.5                  # a factor on every body's mass and inertia
///     wheel_radius: 0.075        # m
///     legs: {length: 1.3, left: {length: 1.015}, right: {length: 0.985}}  # factors on both links
///     stance: {hip: 0.1, knee: 0.17}  # rad, where the scenario does not say its own
///     actuators:                 # of both legs (models/actuator.hpp); others stay as in the MJCF
///       knee: {friction: 0.06, armature: 0.003}
///     balancer: {gains: lqr}     # read by whoever balances (scenarios/scenario_file.hpp)
///     tyre: {law: spring_damper} # of both wheels (models/tyre.hpp)
struct RobotDescription {
  std::filesystem::path mjcf;
  double mass = 1.0;
  std::optional<double> wheel_radius;  ///< as in the MJCF if it is not there
  LegLengths legs;
  Stance stance;
  LegActuators actuators;
  Tyre tyre;

  /// What the file says of a servo's actuator, if anything.
  const std::optional<Actuator>& actuator(Servo servo) const;
};

/// All keys but those of `balancer`, which is known and left to who reads it.
void describe(Fields& fields, RobotDescription& robot);

/// Whether a robot's file is YAML about an MJCF, and not an MJCF itself.
bool is_about_an_mjcf(const std::filesystem::path& file);

/// Errors: `InputError` with file:line:column.
RobotDescription robot_description(const std::filesystem::path& file);

/// All that the description depends on, for digests: the text of the file, and of the MJCF it
/// names.
std::string robot_text(const std::filesystem::path& file);

}  // namespace touchdown::models
