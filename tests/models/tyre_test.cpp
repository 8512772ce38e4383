#include "models/tyre.hpp"

#include <filesystem>
#include <numeric>

#include <gtest/gtest.h>

#include "core/files.hpp"
#include "models/robot_model.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::models {
namespace {

class TyreInARobotFile : public ::testing::Test {
 protected:
  RobotModel robot_with(const std::string& tyre) const {
    folder_.write("upkie.xml", read_file(upkie_mjcf));
    return compile_robot_model(folder_.write("robot.yaml", "mjcf: upkie.xml\ntyre: " + tyre + "\n"),
                               Terrain{});
  }

  ScratchFolder folder_;
};

TEST_F(TyreInARobotFile, IsTheEnginesByDefault) {
  EXPECT_EQ(compile_robot_model(upkie_mjcf, Terrain{}).tyre.law, Tyre::Law::engine);
  EXPECT_EQ(robot_with("{}").tyre.law, Tyre::Law::engine);
  EXPECT_EQ(robot_with("{law: engine}").tyre.law, Tyre::Law::engine);
  const RobotModel robot = robot_with("{law: spring_damper, stiffness: 5e4, damping: 80}");
  EXPECT_EQ(robot.tyre.law, Tyre::Law::spring_damper);
  EXPECT_EQ(robot.tyre.stiffness, 5e4);
  EXPECT_EQ(robot.tyre.damping, 80.0);
  EXPECT_EQ(robot.tyre_strips[0], std::vector<int>{robot.tyre_geom[0]}) << "one sphere";
}

TEST_F(TyreInARobotFile, OfSomeWidthIsMasslessSpheresBesideEachOther) {
  const RobotModel plain = compile_robot_model(upkie_mjcf, Terrain{});
  const RobotModel robot = robot_with("{law: spring_damper, width: 0.03}");
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    const int tyre = robot.tyre_geom[wheel];
    ASSERT_EQ(robot.tyre_strips[wheel].size(), 3U);
    EXPECT_EQ(robot.tyre_strips[wheel][0], tyre);
    double offsets = 0.0;
    for (const int strip : robot.tyre_strips[wheel]) {
      const Eigen::Vector3d beside =
          vector_at(robot.mj->geom_pos, strip) - vector_at(robot.mj->geom_pos, tyre);
      EXPECT_EQ(beside.x(), 0.0);
      EXPECT_EQ(beside.z(), 0.0);
      offsets += std::abs(beside.y());
      EXPECT_EQ(robot.mj->geom_bodyid[strip], robot.mj->geom_bodyid[tyre]);
      EXPECT_EQ(robot.mj->geom_type[strip], mjGEOM_SPHERE);
      EXPECT_EQ(robot.mj->geom_size[3 * strip], 0.05);
      EXPECT_EQ(robot.mj->geom_contype[strip], robot.mj->geom_contype[tyre]);
      EXPECT_EQ(robot.mj->geom_conaffinity[strip], robot.mj->geom_conaffinity[tyre]);
      EXPECT_EQ(robot.mj->geom_group[strip], robot.mj->geom_group[tyre]) << "not drawn";
    }
    EXPECT_NEAR(offsets, 2 * 0.01, 1e-12) << "a third of the width to either side";
  }
  ASSERT_EQ(robot.mj->nbody, plain.mj->nbody);
  for (int body = 0; body < 7; ++body) {
    EXPECT_EQ(robot.mj->body_mass[body], plain.mj->body_mass[body]);
    EXPECT_EQ(vector_at(robot.mj->body_inertia, body), vector_at(plain.mj->body_inertia, body));
  }
}

}  // namespace
}  // namespace touchdown::models
