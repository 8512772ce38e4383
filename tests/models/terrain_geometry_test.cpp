#include <cmath>
#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include "models/robot_model.hpp"
#include "models/terrain_mesh.hpp"
#include "tests/models/terrains.hpp"
#include "tests/models/upkie_mjcf.hpp"

namespace touchdown::models {
namespace {

std::vector<Terrain> all_terrains() {
  return {stairs(), course(),
          Terrain{.pieces = {Flat{3.0}, StairFlight{.count = 6}, Step{.drop = 0.5}}},
          Terrain{.pieces = {Flat{1.0}, Platform{2.0, 0.4, 0.02}, Flat{1.0}}, .start_x = 0},
          Terrain{.pieces = {Ramp{20.0, 0.3}, Flat{0.5}, Platform{0.5, 0.1, 0.0}, Flat{0.5},
                             Ramp{15.0, -0.3}}}};
}

/// Height of the ground that a falling ball would hit beside the robot.
double highest_collider(const mjModel& model, const mjData& data, double x, double y = -1.1) {
  const mjtNum down[3] = {0, 0, -1};
  const mjtByte groups[mjNGROUP] = {0, 0, 0, 1, 0, 0};  // planes are hit whatever their group
  double z = 5.0;
  while (true) {
    const mjtNum from[3] = {x, y, z};
    int geom = -1;
    const double distance = mj_ray(&model, &data, from, down, groups, 1, -1, &geom);
    if (distance < 0) return -1.0;
    z -= distance;
    if (model.geom_contype[geom] != 0) return z;
    z -= 1e-7;  // what is only drawn: look below it
  }
}

/// A ray from above hits the collision geoms at the height of the profile.
TEST(TerrainGeometry, CollisionSurfaceIsTheHeight) {
  for (const Terrain& terrain : all_terrains()) {
    const RobotModel robot = compile_robot_model(upkie_mjcf, terrain);
    mjData* data = mj_makeData(robot.mj.get());
    mj_forward(robot.mj.get(), data);
    for (double x = terrain.start_x - 0.5; x < 9.0; x += 0.00371) {
      // Within a millimetre of a drop the recessed riser leaves a slit.
      bool near_edge = false;
      for (const double edge : edges(terrain)) near_edge |= std::abs(x - edge) < 2e-3;
      if (near_edge) continue;
      EXPECT_NEAR(highest_collider(*robot.mj, *data, x), height_at(terrain, x), 1e-6) << x;
    }
    mj_deleteData(data);
  }
}

TEST(TerrainGeometry, StripsLieBesideEachOther) {
  const Terrain terrain{.pieces = {Flat{3.0}, Step{0.1, 0.01}},
                        .start_x = -1.0,
                        .width = 1.0,
                        .beside = {{{Ramp{10.0, 0.05}, Flat{0.5}, Step{0.05, 0.01}}, 1.0, 1.0, 0.8},
                                   {{Flat{1.0}, Step{0.2, 0.0}}, 0.0, -0.9, 0.4}}};
  const RobotModel robot = compile_robot_model(upkie_mjcf, terrain);
  mjData* data = mj_makeData(robot.mj.get());
  mj_forward(robot.mj.get(), data);
  const auto height = [&](double x, double y) { return highest_collider(*robot.mj, *data, x, y); };
  EXPECT_NEAR(height(1.6, 0.2), 0.1, 1e-6);  // what the robot starts on
  EXPECT_NEAR(height(1.6, 1.0), 0.05, 1e-6);
  EXPECT_NEAR(height(1.0 + 0.5 * 0.05 / std::tan(M_PI / 18.0), 1.3), 0.025, 1e-6);
  EXPECT_NEAR(height(0.5, -1.0), 0.2, 1e-6);
  for (const double y : {0.55, 1.45, -0.65, -1.15}) EXPECT_NEAR(height(0.5, y), 0.0, 1e-6) << y;
  mj_deleteData(data);
}

using Point = std::tuple<long, long, long>;

Point rounded(const Mesh::Vertex& vertex) {
  return {std::lround(1e7 * vertex.x), std::lround(1e7 * vertex.y), std::lround(1e7 * vertex.z)};
}

TEST(TerrainMesh, IsClosed) {
  for (const Terrain& terrain : all_terrains()) {
    const std::vector<Mesh> meshes = visual_meshes(Profile(terrain), terrain.width);
    EXPECT_FALSE(meshes.empty());
    for (const Mesh& mesh : meshes) {
      std::map<std::pair<Point, Point>, int> uses;
      for (const auto& face : mesh.faces) {
        for (std::size_t k = 0; k < 3; ++k) {
          const Point a = rounded(mesh.vertices[static_cast<std::size_t>(face[k])]);
          const Point b = rounded(mesh.vertices[static_cast<std::size_t>(face[(k + 1) % 3])]);
          ASSERT_NE(a, b);
          ++uses[{a, b}];
        }
      }
      for (const auto& [edge, count] : uses) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(uses.count({edge.second, edge.first}), 1u);
      }
    }
  }
}

/// The enclosed volume is the area under the profile times the width.
TEST(TerrainMesh, EnclosesTheGroundAboveTheFloor) {
  for (const Terrain& terrain : all_terrains()) {
    double volume = 0.0;
    for (const Mesh& mesh : visual_meshes(Profile(terrain), terrain.width)) {
      for (const auto& face : mesh.faces) {
        const auto corner = [&](std::size_t k) {
          const Mesh::Vertex& v = mesh.vertices[static_cast<std::size_t>(face[k])];
          return Eigen::Vector3d(v.x, v.y, v.z);
        };
        volume += corner(0).dot(corner(1).cross(corner(2))) / 6.0;
      }
    }
    double area = 0.0;
    const double dx = 1e-4;
    for (double x = terrain.start_x - 0.1; x < 15.0; x += dx) area += dx * height_at(terrain, x);
    EXPECT_NEAR(volume, area * terrain.width, 2e-3 * volume);
  }
}

TEST(TerrainMesh, NormalsPointOutOfTheirFaces) {
  for (const Terrain& terrain : all_terrains()) {
    for (const Mesh& mesh : visual_meshes(Profile(terrain), terrain.width)) {
      for (const auto& face : mesh.faces) {
        std::array<Eigen::Vector3d, 3> p, n;
        for (std::size_t k = 0; k < 3; ++k) {
          const Mesh::Vertex& v = mesh.vertices[static_cast<std::size_t>(face[k])];
          p[k] = {v.x, v.y, v.z};
          n[k] = {v.nx, v.ny, v.nz};
        }
        const Eigen::Vector3d outward = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
        for (const Eigen::Vector3d& normal : n) {
          EXPECT_NEAR(normal.norm(), 1.0, 1e-9);
          EXPECT_GT(normal.dot(outward), 0.9);
        }
      }
    }
  }
}

/// A ball at rest on the terrain has the terrain's friction, not the robot's.
TEST(TerrainGeometry, TerrainDecidesFrictionAndStiffness) {
  Terrain terrain;
  terrain.friction = 0.37;
  const RobotModel robot = compile_robot_model(upkie_mjcf, terrain);
  mjData* data = mj_makeData(robot.mj.get());
  data->qpos[2] = 0.5565;  // tyres half a millimetre into the floor
  mj_forward(robot.mj.get(), data);
  ASSERT_EQ(data->ncon, 2);
  for (int i = 0; i < data->ncon; ++i) {
    EXPECT_DOUBLE_EQ(data->contact[i].friction[0], 0.37);
    EXPECT_DOUBLE_EQ(data->contact[i].solref[0], 0.01);
    EXPECT_EQ(data->contact[i].dim, 3);
  }
  mj_deleteData(data);
}

}  // namespace
}  // namespace touchdown::models
