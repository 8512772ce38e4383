#pragma once

#include <array>
#include <string>
#include <vector>

#include "models/profile.hpp"
#include "models/terrain.hpp"

namespace touchdown::models {

/// A triangle mesh. A vertex on a hard edge is stored once per face.
struct Mesh {
  struct Vertex {
    double x, y, z;
    double nx, ny, nz;
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<int, 3>> faces;  ///< counter-clockwise seen from outside
};

/// One closed mesh per connected part of the ground above the floor. It is drawn instead of the
/// collision geoms: the renderer's shadow pass draws stripes on any face that lies on another geom.
std::vector<Mesh> visual_meshes(const Profile& profile, double width);

/// The scene of a robot as MJCF text: solver settings, light, sky, materials and the terrain. It
/// follows the robot's own sections and overrides them. The terrain's geoms are named
/// `touchdown_floor` and `touchdown_terrain_<n>`. Colliders are in group 3 (the floor is drawn)
/// with contype 2 and conaffinity 1. Their priority is above the robot's, so that the terrain's
/// friction and contact parameters apply.
std::string scene_mjcf(const Terrain& terrain);

}  // namespace touchdown::models
