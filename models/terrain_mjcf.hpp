#pragma once

#include <string>

#include "models/terrain.hpp"

namespace touchdown::models {

/// The `<asset>` and `<worldbody>` sections of a terrain as MJCF text. Geoms are named
/// `touchdown_floor` and `touchdown_terrain_<n>`; they collide as group 3 (the floor is drawn) with
/// contype 2, conaffinity 1, and a priority above the robot's: the terrain's friction and contact
/// parameters count.
std::string terrain_mjcf(const Terrain& terrain);

}  // namespace touchdown::models
