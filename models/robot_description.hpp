#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "models/actuator.hpp"
#include "models/robot.hpp"
#include "models/tyre.hpp"

namespace touchdown::models {

/// Actuators of each kind of joint, the same in both legs.
struct LegActuators {
  std::optional<Actuator> hip, knee, wheel;
};

/// Leg lengths, as factors on both links of a leg. The factor of one leg multiplies the factor of
/// both. It models a manufacturing difference between the legs, the same in every run.
struct LegLengths {
  double both = 1.0;
  std::array<double, 2> one = {1.0, 1.0};  ///< left, right
};

/// Default joint angles of the legs, for scenarios that do not specify them (rad).
struct Stance {
  double hip = 0.455;
  double knee = 0.791;
};

/// The servo of held joints: torque = clamp(kp·(reference − q) − kd·q̇, ± maximum_torque). Absent
/// values are those of the robot's file; gains that it lacks follow from its weight.
struct HeldServo {
  std::optional<double> kp;              ///< N·m/rad
  std::optional<double> kd;              ///< N·m·s/rad
  std::optional<double> maximum_torque;  ///< N·m
};

/// A point at which two bodies of a cut loop are one.
struct LoopKeys {
  std::vector<std::string> bodies;  ///< two
  std::vector<double> anchor;       ///< in the first body (m)
  /// In the second body (m); if empty, where `anchor` is in the pose of the file.
  std::vector<double> second_anchor;
};

/// The parts of a robot in its MJCF or URDF. An empty name stands for the name in the contract
/// (docs/guides/robots.md).
struct PartNames {
  std::array<std::string, servo_count> joint;  ///< in servo order
  bool has_hips = true;                        ///< false: legs of a knee and a wheel
  std::vector<std::string> held;               ///< joints that a servo keeps at their reference
  std::vector<LoopKeys> loops;                 ///< besides the file's <connect>s
  std::array<std::vector<std::string>, wheel_count>
      motors;                                 ///< joints that get motors: left, right
  std::array<std::string, wheel_count> tyre;  ///< geoms, or bodies with one round collider
  double tyre_radius = 0.0;                   ///< of spheres in place of these colliders (m)
  std::vector<std::string> no_collision;      ///< geoms, or bodies, that touch nothing
  std::string forward = "auto";               ///< the axis that faces forward: x, -x, y, -y
  std::string imu;                            ///< a site, or a body with the frame of the IMU
  std::string base;                           ///< the floating link of a URDF
};

/// A robot as described by a file. The file is either an MJCF, with joints that may have
/// `frictionloss`, `damping` and `armature`, or a YAML file that modifies an MJCF:
///
///     # Upkie with a load, large wheels and long legs, the left leg 3 % longer.
///     mjcf: upkie.xml            # beside this file
///     mass: 1.5                  # factor on every body's mass and inertia
///     wheel_radius: 0.075        # m
///     legs: {length: 1.3, left: {length: 1.015}, right: {length: 0.985}}  # factors on both links
///     stance: {hip: 0.1, knee: 0.17}  # rad, unless the scenario specifies it
///     actuators:                 # of both legs (models/actuator.hpp); others stay as in the MJCF
///       knee: {friction: 0.06, armature: 0.003}
///     balancer: {gains: lqr}     # read by the balancer (scenarios/scenario_file.hpp)
///     tyre: {law: spring_damper} # of both wheels (models/tyre.hpp)
///
/// or that names the parts of an MJCF or URDF with other names:
///
///     mjcf: robot.urdf
///     base: trunk
///     joints: {left_knee: l_knee, left_wheel: l_axle, right_knee: r_knee, right_wheel: r_axle}
///     hip: none
///     held: [l_hip_roll, r_hip_roll]
///     held_servo: {kp: 200, kd: 10, maximum_torque: 60}
///     tyres: {left: l_tire, right: r_tire}
///     motors: {left: [l_front, l_rear], right: [r_front, r_rear]}       # of closed legs
///     loops: [{bodies: [l_shank, l_rod], anchor: [0, 0, -0.28]}, …]
///     no_collision: [l_guard]
///     forward: -y
///     imu: imu_link
struct RobotDescription {
  std::filesystem::path mjcf;
  double mass = 1.0;
  std::optional<double> wheel_radius;  ///< as in the MJCF if absent
  LegLengths legs;
  Stance stance;
  bool has_stance = false;  ///< whether the file gives the stance, from the zeros of its joints
  LegActuators actuators;
  Tyre tyre;
  PartNames parts;
  HeldServo held_servo;

  /// The actuator of a servo, if the file specifies one.
  const std::optional<Actuator>& actuator(Servo servo) const;
};

/// Describes all keys. The section `balancer` is accepted, but read elsewhere.
void describe(Fields& fields, RobotDescription& robot);

/// Whether a robot's file is a YAML description (`.yaml`, `.yml`), not an MJCF.
bool is_about_an_mjcf(const std::filesystem::path& file);

/// Errors: `InputError` with file:line:column.
RobotDescription robot_description(const std::filesystem::path& file);

/// The keys of a robot's YAML file, for errors at their values.
class RobotKeys {
 public:
  explicit RobotKeys(std::filesystem::path file) : file_(std::move(file)) {}

  /// Throws an `InputError` at a dotted key, such as `joints.left_hip` or `held.0`.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;

 private:
  std::filesystem::path file_;
};

/// All files that the robot depends on: this one, the MJCF or URDF that it names, what that
/// includes, and its meshes and textures; and one digest of their contents, wherever they are.
/// Errors: `InputError` with file:line for a file that cannot be read.
std::vector<std::filesystem::path> robot_files(const std::filesystem::path& file);
std::string robot_digest(const std::filesystem::path& file);

}  // namespace touchdown::models
