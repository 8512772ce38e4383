#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/yaml.hpp"
#include "models/robot_description.hpp"
#include "models/terrain.hpp"
#include "policies/crouching.hpp"
#include "policies/driving.hpp"
#include "policies/forces.hpp"
#include "policies/wheel_contact.hpp"
#include "scenarios/perturbation.hpp"
#include "simulators/options.hpp"

namespace touchdown::scenarios {

/// Where and how the robot stands when the run begins.
struct Start {
  double x = 0.0;                       ///< of the wheels, along the course (m)
  double y = 0.0;                       ///< across it (m)
  double yaw = 0.0;                     ///< heading, positive to the left (rad)
  double hip = models::Stance{}.hip;    ///< crouch: hip angle (rad)
  double knee = models::Stance{}.knee;  ///< crouch: knee angle (rad)
  double clearance = 0.0;               ///< between the tyres and the ground (m)
};

/// When a run is over.
struct End {
  double duration = 30.0;                              ///< the most it may take (s)
  double x = std::numeric_limits<double>::infinity();  ///< finished once the base is past (m)
  double settle = 1.0;                                 ///< and has gone on for (s)
  double fall_tilt = 1.0;                              ///< fell when tilted by more (rad)
};

/// How this very robot differs from its description.
struct Deviations {
  double com_x = 0.0;  ///< where the base body's centre of mass is besides, forward (m)
  double com_z = 0.0;  ///< and upward (m)
  double wheel_radius_scale = 1.0;
  double actuator_friction_scale = 1.0;  ///< of Coulomb's and viscous friction, of every joint
  /// Relative errors of the torque constants, besides what the robot's file says of them.
  std::array<double, models::servo_count> torque_error = {};

  bool operator==(const Deviations&) const = default;
};

/// One experiment's scene: which robot stands on which terrain, what drives it, when it is over.
/// Everything about a run but the engine and the random draws.
struct Scenario {
  std::string name;
  std::filesystem::path robot = "models/upkie.xml";
  models::Terrain terrain;
  Start start;
  policies::WheelBalancerConfig balancer;
  policies::PolicyConfig policy;
  policies::VelocityScript velocity;
  policies::CrouchScript crouch;
  std::optional<policies::Tether> tether;
  std::vector<policies::Guide> guides;
  policies::ForceScript forces;
  /// The mass of the robot that `forces` and random lifts are meant for (kg), if they go with it.
  std::optional<double> forces_for_mass;
  double mass_scale = 1.0;  ///< on the mass and inertia of every body of the robot
  Deviations deviations;
  simulators::SimulatorOptions simulation;
  End end;
  Perturbation perturbation;
};

/// Read a scenario strictly, alone: what it does not say is as `defaults` has it, whatever its
/// robot (scenarios/scenario_file.hpp asks that too). Errors: `InputError` with file:line:column.
Scenario scenario_from_yaml(const YamlDocument& document, const Scenario& defaults = {},
                            const policies::LqrGains& lqr = {});
Scenario load_scenario(const std::filesystem::path& path);

/// All that its robot is made from, for digests.
std::string robot_text(const Scenario& scenario);

/// The scenario as YAML that `scenario_from_yaml` reads back to the same scenario.
std::string to_yaml(const Scenario& scenario);

/// The scenario of run `run`: what `perturbation` allows to vary is drawn from (seed, run), each
/// quantity from its own stream, so that adding one changes no other.
Scenario perturbed(const Scenario& scenario, std::uint64_t seed, std::int64_t run);

}  // namespace touchdown::scenarios
