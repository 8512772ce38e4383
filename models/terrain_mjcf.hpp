#pragma once

#include <string>

#include "models/terrain.hpp"

namespace touchdown::models {

/// The `<asset>` and `<worldbody>` sections of a terrain as MJCF text. Geoms are named
/// `touchdown_floor` and `touchdown_terrain_<n>`. Colliders are in group 3 (the floor is drawn)
/// with contype 2 and conaffinity 1. Their priority is above the robot's, so that the terrain's
/// friction and contact parameters apply.
std::string terrain_mjcf(const Terrain& terrain);

}  // namespace touchdown::models
