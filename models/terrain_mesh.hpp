#pragma once

#include <array>
#include <vector>

#include "models/profile.hpp"

namespace touchdown::models {

/// A triangle mesh; a vertex that belongs to two faces across a hard edge is there twice.
struct Mesh {
  struct Vertex {
    double x, y, z;
    double nx, ny, nz;
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<int, 3>> faces;  ///< counter-clockwise seen from outside
};

/// One closed mesh per stretch of ground above the floor. Closed, and drawn instead of the
/// collision geoms, because the renderer's shadow pass stripes any face that lies on another geom.
std::vector<Mesh> visual_meshes(const Profile& profile, double width);

}  // namespace touchdown::models
