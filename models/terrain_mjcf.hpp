#pragma once

#include <string>

#include "models/terrain.hpp"

namespace touchdown::models {

/// How hard a tyre's contact with the ground is: MuJoCo's `solref` (time constant in s, damping
/// ratio). Peak landing acceleration from 0.25 m: 334, 224, 135 m/s² at 0.005, 0.01, 0.02 s.
struct ContactParameters {
  double time_constant = 0.01;
  double damping_ratio = 1.0;
};

/// The `<asset>` and `<worldbody>` sections of a terrain as MJCF text. Geoms are named
/// `touchdown_floor` and `touchdown_terrain_<n>`; they collide as group 3 (the floor is drawn) with
/// contype 2, conaffinity 1, and a priority above the robot's: the terrain's friction and contact
/// parameters count.
std::string terrain_mjcf(const Terrain& terrain, const ContactParameters& contact);

}  // namespace touchdown::models
