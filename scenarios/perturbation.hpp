#pragma once

#include <optional>

#include "scenarios/random_scripts.hpp"

namespace touchdown::scenarios {

/// What a scenario lets vary from run to run, each uniformly within ± its half width around the
/// scenario's own value (`*_scale`: a factor within 1 ± the half width).
struct Perturbation {
  double x = 0.0;                 ///< starting place along the course (m)
  double y = 0.0;                 ///< across it (m)
  double yaw = 0.0;               ///< starting heading (rad)
  double velocity = 0.0;          ///< added to every commanded velocity that is not zero (m/s)
  double crouch = 0.0;            ///< hip angle (rad); the knee bends along, keeping the foot level
  double mass_scale = 0.0;        ///< mass and inertia of every body
  double friction = 0.0;          ///< of the terrain
  double servo_gain_scale = 0.0;  ///< position and velocity gains of the legs' servos
  double force_scale = 0.0;       ///< every external force
  std::optional<RandomDrive> drive;  ///< instead of the scenario's own velocity script
  std::optional<RandomLifts> lift;   ///< besides the scenario's own forces
};

void describe(Fields& fields, Perturbation& perturbation);

}  // namespace touchdown::scenarios
