#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <mujoco/mujoco.h>

namespace touchdown::render {

enum class Shape : int { box, sphere, cylinder, mesh };

/// One solid of a body. Lengths are in metres, poses in the frame of the body.
struct Primitive {
  Shape shape = Shape::box;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d size = Eigen::Vector3d::Ones();  ///< in all; a cylinder's axis is z
  std::array<float, 4> colour = {};                ///< red, green, blue, opacity
  int mesh = -1;                                   ///< number of the mesh in the model
};

/// Everything that films draw of a body; body 0 is the terrain. A plane becomes a thin box, a
/// capsule two spheres and a cylinder.
std::vector<Primitive> primitives_of(const mjModel& model, int body);

/// The name of a body; "world" of body 0.
std::string body_name(const mjModel& model, int body);

/// Triangles of a mesh.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;  ///< m
  std::vector<int> indices;               ///< three per triangle
};
TriangleMesh mesh_of(const mjModel& model, int mesh);

}  // namespace touchdown::render
