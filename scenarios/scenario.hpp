#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/key.hpp"
#include "core/yaml.hpp"
#include "logs/recording.hpp"
#include "models/robot_description.hpp"
#include "models/terrain.hpp"
#include "policies/commands.hpp"
#include "policies/forces.hpp"
#include "policies/wheel_contact.hpp"
#include "scenarios/perturbation.hpp"
#include "simulators/options.hpp"

namespace touchdown::scenarios {

/// Position and stance of the robot at the start of a run.
struct Start {
  double x = 0.0;                       ///< of the wheels, along the course (m)
  double y = 0.0;                       ///< of the wheels, across it (m)
  double yaw = 0.0;                     ///< heading, positive to the left (rad)
  double hip = models::Stance{}.hip;    ///< crouch: hip angle (rad)
  double knee = models::Stance{}.knee;  ///< crouch: knee angle (rad)
  double clearance = 0.0;               ///< between the tyres and the ground (m)
};

/// When a run is over.
struct End {
  double duration = 30.0;  ///< longest duration of the run (s)
  double x =
      std::numeric_limits<double>::infinity();  ///< finish line of the base, along the course (m)
  double settle = 1.0;     ///< the run finishes this long after the base passed `x` (s)
  double fall_tilt = 1.0;  ///< a larger tilt is a fall (rad)
};

/// How the robot of one run differs from its description.
struct Deviations {
  double com_x = 0.0;    ///< offset of the base body's centre of mass, forward (m)
  double com_z = 0.0;    ///< and upward (m)
  double payload = 0.0;  ///< that the base body carries at its centre of mass (kg)
  double wheel_radius_scale = 1.0;
  double actuator_friction_scale = 1.0;  ///< on Coulomb and viscous friction of every joint
  /// Relative errors of the torque constants, added to those in the robot's file.
  std::array<double, models::servo_count> torque_error = {};

  bool operator==(const Deviations&) const = default;
};

/// Robot, terrain, policy, commands, forces and end of a run: everything but the engine and the
/// random draws.
struct Scenario {
  std::string name;
  std::filesystem::path robot = "models/upkie.xml";
  std::optional<models::Tyre> tyre;  ///< instead of the robot's own
  models::Terrain terrain;
  Start start;
  policies::WheelBalancerConfig balancer;
  policies::PolicyConfig policy;
  policies::VelocityScript velocity;
  policies::CrouchScript crouch;
  /// Crouches that the robot's joints cannot have end where their ranges do.
  bool clip_crouches = false;
  std::optional<policies::Tether> tether;
  std::vector<policies::Guide> guides;
  policies::ForceScript forces;
  /// Mass that `forces`, random lifts and `tyre` are written for (kg), if they scale with the mass.
  std::optional<double> forces_for_mass;
  double mass_scale = 1.0;  ///< on mass and inertia of every body
  Deviations deviations;
  simulators::SimulatorOptions simulation;
  End end;
  Perturbation perturbation;
};

/// Reads a scenario strictly. `defaults` provides the values that it does not specify, whatever its
/// robot; scenarios/scenario_file.hpp reads those of the robot too.
/// Errors: `InputError` with file:line:column.
Scenario scenario_from_yaml(const YamlDocument& document, const Scenario& defaults = {},
                            const policies::LqrGains& lqr = {});

/// The keys of a scenario file.
std::vector<Key> scenario_keys();

/// The digest of all files that describe its robot.
std::string robot_digest(const Scenario& scenario);

/// The scenario as YAML that `scenario_from_yaml` reads back to the same scenario.
std::string to_yaml(const Scenario& scenario);

/// No draw of a run's hip angle is nearer to a straight leg than this (rad).
inline constexpr double least_bend = 0.03;

/// The scenario of run `run`: the quantities of `perturbation` are drawn from (seed, run). Each has
/// its own stream, so adding one changes no other. No draw bends knees backwards.
Scenario perturbed(const Scenario& scenario, std::uint64_t seed, std::int64_t run);

/// An outcome in running text: "timed out", "left the terrain".
std::string outcome_text(logs::Outcome outcome);

/// How and when a run ended, and why if it ended early: "finished after 27.552 s", "fell after
/// 1.048 s: pitch beyond 1 rad". `end` holds the limits of the run's scenario.
std::string ending_text(const logs::Recording& recording, const End& end);

}  // namespace touchdown::scenarios
