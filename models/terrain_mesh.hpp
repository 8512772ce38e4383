#pragma once

#include <array>
#include <vector>

#include "models/profile.hpp"

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

}  // namespace touchdown::models
