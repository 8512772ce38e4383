#pragma once

#include <array>
#include <string>
#include <vector>

#include "models/profile.hpp"

namespace touchdown {

/// How hard a tyre's contact with the ground is: MuJoCo's `solref` (time constant in s, damping
/// ratio). Peak landing acceleration from 0.25 m: 334, 224, 135 m/s² at 0.005, 0.01, 0.02 s.
struct ContactParameters {
  double time_constant = 0.01;
  double damping_ratio = 1.0;
};

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

/// The `<asset>` and `<worldbody>` sections of a terrain as MJCF text. Geoms are named
/// `touchdown_floor` and `touchdown_terrain_<n>`; they collide as group 3 (the floor is drawn) with
/// contype 2, conaffinity 1, and a priority above the robot's: the terrain's friction and contact
/// parameters count.
std::string terrain_mjcf(const Terrain& terrain, const ContactParameters& contact);

}  // namespace touchdown
