#include "render/film/primitives.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "models/robot_model.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::render {
namespace {

/// A model with one body of these geoms, on a terrain.
models::MjModelPtr model_of(const std::string& geoms, const std::string& terrain = {}) {
  const ScratchFolder folder;
  const auto file = folder.write(
      "m.xml", fmt::format("<mujoco><asset><mesh name=\"m\" vertex=\"0 0 0 1 0 0 0 1 0 0 0 1\"/>"
                           "</asset><worldbody>{}<body name=\"b\"><freejoint/>{}</body></worldbody>"
                           "</mujoco>",
                           terrain, geoms));
  std::array<char, 500> error = {};
  models::MjModelPtr model(mj_loadXML(file.c_str(), nullptr, error.data(), error.size()));
  EXPECT_TRUE(model) << error.data();
  return model;
}

double volume(const Primitive& primitive) {
  const double box = primitive.size.prod();
  if (primitive.shape == Shape::sphere) return box * M_PI / 6.0;
  if (primitive.shape == Shape::cylinder) return box * M_PI / 4.0;
  return box;
}

/// MuJoCo's mass of a geom of unit density is its volume.
TEST(Primitives, HaveTheVolumeThatMujocoComputes) {
  for (const char* geom :
       {"type=\"box\" size=\"0.1 0.2 0.3\"", "type=\"sphere\" size=\"0.4\"",
        "type=\"ellipsoid\" size=\"0.1 0.3 0.2\"", "type=\"cylinder\" size=\"0.1 0.5\""}) {
    const auto model =
        model_of(fmt::format("<geom {} density=\"1\" pos=\"1 2 3\" euler=\"10 20 30\"/>", geom));
    const auto primitives = primitives_of(*model, 1);
    ASSERT_EQ(primitives.size(), 1U) << geom;
    EXPECT_NEAR(volume(primitives[0]), model->body_mass[1], 1e-9) << geom;
    EXPECT_LT((primitives[0].position - Eigen::Vector3d(1, 2, 3)).norm(), 1e-12) << geom;
  }
}

/// A capsule's ends are half spheres: its cylinder and one sphere make its volume.
TEST(Primitives, ACapsuleIsACylinderWithASphereAtEachEnd) {
  const auto model =
      model_of("<geom type=\"capsule\" fromto=\"0 0 0 0 0.6 0\" size=\"0.1\" density=\"1\"/>");
  const auto primitives = primitives_of(*model, 1);
  ASSERT_EQ(primitives.size(), 3U);
  EXPECT_NEAR(volume(primitives[0]) + volume(primitives[2]), model->body_mass[1], 1e-9);
  const double apart = (primitives[0].position - primitives[1].position).norm();
  EXPECT_NEAR(apart, 0.6, 1e-9);
  EXPECT_LT((primitives[2].position - Eigen::Vector3d(0, 0.3, 0)).norm(), 1e-9);
}

/// The surface of a plane is the upper side of its box.
TEST(Primitives, APlaneIsAThinBoxBelowItsSurface) {
  const auto model = model_of("<geom size=\"0.1\"/>",
                              "<geom type=\"plane\" size=\"2 3 1\" pos=\"0 0 0.5\"/>"
                              "<geom type=\"plane\" size=\"0 0 1\" zaxis=\"1 0 1\"/>");
  ASSERT_TRUE(model);
  const auto primitives = primitives_of(*model, 0);
  ASSERT_EQ(primitives.size(), 2U);
  EXPECT_NEAR(primitives[0].position.z() + 0.5 * primitives[0].size.z(), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(primitives[0].size.x(), 4.0);
  EXPECT_DOUBLE_EQ(primitives[0].size.y(), 6.0);
  const Primitive& endless = primitives[1];
  const Eigen::Vector3d up = endless.orientation * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(endless.position.dot(up) + 0.5 * endless.size.z(), 0.0, 1e-9);
  EXPECT_GT(endless.size.x(), 10.0);
}

TEST(Primitives, WhatFilmsDoNotDrawIsLeftOut) {
  const auto model = model_of(
      "<geom size=\"0.1\" group=\"3\"/><geom size=\"0.2\" group=\"5\"/>"
      "<geom size=\"0.3\" rgba=\"1 0 0 0\"/><geom size=\"0.4\" group=\"2\"/>");
  const auto primitives = primitives_of(*model, 1);
  ASSERT_EQ(primitives.size(), 1U);
  EXPECT_NEAR(primitives[0].size.x(), 0.8, 1e-12);
}

/// A mesh in its body's frame has the vertices of its file, wherever MuJoCo centres it.
TEST(Primitives, MeshesKeepTheirPlace) {
  const auto model = model_of("<geom type=\"mesh\" mesh=\"m\"/>");
  const auto primitives = primitives_of(*model, 1);
  ASSERT_EQ(primitives.size(), 1U);
  ASSERT_EQ(primitives[0].shape, Shape::mesh);
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9), high = -low;
  const TriangleMesh mesh = mesh_of(*model, primitives[0].mesh);
  ASSERT_EQ(mesh.vertices.size(), 4U);
  for (const Eigen::Vector3d& in_mesh : mesh.vertices) {
    const Eigen::Vector3d vertex = primitives[0].position + primitives[0].orientation * in_mesh;
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  EXPECT_LT((low - Eigen::Vector3d::Zero()).norm(), 1e-6);
  EXPECT_LT((high - Eigen::Vector3d::Ones()).norm(), 1e-6);
  EXPECT_EQ(mesh.indices.size() % 3, 0U);
}

}  // namespace
}  // namespace touchdown::render
