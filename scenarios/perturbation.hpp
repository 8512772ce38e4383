#pragma once

#include <cstdint>
#include <optional>

#include "policies/commands.hpp"
#include "policies/forces.hpp"

namespace touchdown::scenarios {

/// A quantity drawn uniformly between two values; `[low, high]` in YAML.
struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// Imitates a person at a joystick: random commands, each held for a while.
struct RandomDrive {
  double velocity = 0.5;    ///< half width (m/s)
  double yaw_rate = 0.5;    ///< half width (rad/s)
  double standing = 0.2;    ///< share of commands to stand still
  Range hold = {1.0, 3.0};  ///< how long each command lasts (s)
  double start = 1.0;       ///< the first command's time (s)
};

/// Makes the robot crouch and rise: random heights, each held for a while.
struct RandomCrouches {
  Range hip = {0.0, 0.6};   ///< angle (rad)
  double exponent = 1.0;    ///< of the uniform draw; above 1, the low end is likelier
  Range hold = {2.0, 6.0};  ///< how long each command lasts, motion included (s)
  double rate = 0.3;        ///< of the hip's motion (rad/s)
  double start = 0.0;       ///< the first command's time (s)
};

/// Lifts the robot and releases it: random upward forces with pauses between.
struct RandomLifts {
  Range force = {40.0, 60.0};  ///< N
  Range hold = {0.2, 0.6};     ///< how long each lift lasts (s)
  Range pause = {0.5, 1.5};    ///< between one lift and the next (s)
  double start = 1.0;          ///< the first lift's time (s)
  /// Where the force acts, in the base frame (m).
  Eigen::Vector3d point_in_base = {0.0, 0.0, 0.06};
};

/// Half widths of the quantities that vary from run to run. Each is drawn uniformly within ± its
/// half width around the scenario's value (`*_scale`: a factor within 1 ± the half width).
struct Perturbation {
  double x = 0.0;                   ///< starting position along the course (m)
  double y = 0.0;                   ///< starting position across it (m)
  double yaw = 0.0;                 ///< starting heading (rad)
  double velocity = 0.0;            ///< added to every commanded velocity that is not zero (m/s)
  double crouch = 0.0;              ///< hip angle (rad); the knee follows in proportion
  double mass_scale = 0.0;          ///< mass and inertia of every body
  double friction = 0.0;            ///< of the terrain
  double servo_gain_scale = 0.0;    ///< position and velocity gains of the legs' servos
  double force_scale = 0.0;         ///< every external force
  double com_x = 0.0;               ///< the base body's centre of mass, along the robot (m)
  double com_z = 0.0;               ///< and up (m)
  double wheel_radius_scale = 0.0;  ///< both wheels
  double actuator_friction_scale = 0.0;          ///< of every joint
  double torque_error = 0.0;                     ///< of each servo's torque constant, independently
  std::optional<RandomDrive> drive = {};         ///< instead of the scenario's own velocity script
  std::optional<RandomCrouches> crouching = {};  ///< instead of the scenario's own crouch script
  std::optional<RandomLifts> lift = {};          ///< besides the scenario's own forces
};

void describe(Fields& fields, Perturbation& perturbation);

/// Draws the script of one run, until `duration` (s); a pure function of its arguments.
policies::VelocityScript random_drive(const RandomDrive& drive, double duration, std::uint64_t seed,
                                      std::int64_t run);
policies::CrouchScript random_crouches(const RandomCrouches& crouches, double duration,
                                       std::uint64_t seed, std::int64_t run);
policies::ForceScript random_lifts(const RandomLifts& lifts, double duration, std::uint64_t seed,
                                   std::int64_t run);

}  // namespace touchdown::scenarios
