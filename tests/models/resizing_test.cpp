#include "models/resizing.hpp"

#include <cstring>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/files.hpp"
#include "models/robot_description.hpp"
#include "models/robot_model.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::models {
namespace {

class RobotOfAnotherSize : public ::testing::Test {
 protected:
  RobotOfAnotherSize() { std::filesystem::copy_file(upkie_mjcf, folder_ / "upkie.xml"); }

  RobotModel with(const std::string& text) const {
    write_atomically(folder_ / "robot.yaml", "mjcf: upkie.xml\n" + text);
    return compile_robot_model(folder_ / "robot.yaml", Terrain{});
  }

  ScratchFolder folder_;
  const RobotModel upkie_ = compile_robot_model(upkie_mjcf, Terrain{});
};

int body(const RobotModel& robot, const char* name) {
  return mj_name2id(robot.mj.get(), mjOBJ_BODY, name);
}

/// About the body's centre of mass, in its frame.
Eigen::Matrix3d inertia(const RobotModel& robot, const char* name) {
  const int id = body(robot, name);
  const Eigen::Matrix3d axes = quaternion_at(robot.mj->body_iquat, id).toRotationMatrix();
  return axes * vector_at(robot.mj->body_inertia, id).asDiagonal() * axes.transpose();
}

/// Where a joint is.
Eigen::Vector3d anchor(const RobotModel& robot, const char* joint, const mjData& data) {
  return vector_at(data.xanchor, mj_name2id(robot.mj.get(), mjOBJ_JOINT, joint));
}

TEST_F(RobotOfAnotherSize, IsHeavierInEveryBodyAlike) {
  const RobotModel heavy = with("mass: 1.5\n");
  for (int i = 1; i < upkie_.mj->nbody; ++i) {
    EXPECT_DOUBLE_EQ(heavy.mj->body_mass[i], 1.5 * upkie_.mj->body_mass[i]);
  }
  EXPECT_NEAR(heavy.mj->body_subtreemass[heavy.base_body], 1.5 * 5.33922, 1e-5);
  EXPECT_TRUE(inertia(heavy, "left_wheel").isApprox(1.5 * inertia(upkie_, "left_wheel"), 1e-12));
}

TEST_F(RobotOfAnotherSize, HasLargerWheelsOfTheSameWidthAndMass) {
  const RobotModel large = with("wheel_radius: 0.075\n");
  EXPECT_NEAR(large.wheel_radius, 0.075, 1e-15);
  for (const int tyre : large.tyre_geom) {
    EXPECT_NEAR(large.mj->geom_size[3 * tyre], 0.075, 1e-15);
    EXPECT_NEAR(large.mj->geom_rbound[tyre], 0.075, 1e-15) << "what collisions are looked for in";
  }
  EXPECT_EQ(large.mj->body_mass[body(large, "left_wheel")], 0.18455);
  // About the axle (y) all matter is 1.5 times as far away; about z only its x is.
  const Eigen::Matrix3d before = inertia(upkie_, "left_wheel");
  const Eigen::Matrix3d after = inertia(large, "left_wheel");
  EXPECT_NEAR(after(1, 1), 2.25 * 1.745612e-4, 1e-12);
  const double xx = 0.5 * (before(1, 1) + before(2, 2) - before(0, 0));
  const double yy = 0.5 * (before(0, 0) + before(2, 2) - before(1, 1));
  EXPECT_NEAR(after(2, 2), 2.25 * xx + yy, 1e-12);
  // What is drawn: the tyre's cylinder (the second geom of the wheel) has the collider's radius.
  const int drawn = large.tyre_geom[0] + 1;
  EXPECT_NEAR(large.mj->geom_size[3 * drawn], 0.075, 1e-12);
  EXPECT_NEAR(large.mj->geom_size[3 * drawn + 1], 0.02, 1e-12);
}

TEST_F(RobotOfAnotherSize, HasLongerLegsWithAllThatIsOnThem) {
  const RobotModel robot = with("legs: {length: 1.4}\n");
  const MjDataPtr data = at_zero(robot);
  // Frames are the base's at zero angles: lengths along z, distances across as they were.
  EXPECT_TRUE(anchor(robot, "left_knee", *data)
                  .isApprox(Eigen::Vector3d(0.0, 0.1142 + 0.0962, -0.164 - 1.4 * 0.168), 1e-12));
  EXPECT_TRUE(
      anchor(robot, "right_wheel", *data)
          .isApprox(Eigen::Vector3d(0.0, -0.1142 - 0.0962 + 0.012, -0.164 - 1.4 * (0.168 + 0.175)),
                    1e-12));
  const int upper = body(robot, "left_upper_leg");
  EXPECT_EQ(robot.mj->body_mass[upper], 0.69241);
  EXPECT_TRUE(vector_at(robot.mj->body_ipos, upper)
                  .isApprox(Eigen::Vector3d(0.0, 0.064806, -1.4 * 0.143655), 1e-12));
  // The collider at the knee is as round as it was, and still at the knee.
  const int knee = robot.mj->body_geomadr[upper];
  EXPECT_EQ(robot.mj->geom_size[3 * knee], 0.05);
  EXPECT_NEAR(robot.mj->geom_pos[3 * knee + 2], -1.4 * 0.168, 1e-12);
}

TEST_F(RobotOfAnotherSize, HasLegsWithTheInertiaOfTheSameMatterStretched) {
  const double f = 1.4;
  const Eigen::Matrix3d after = inertia(with("legs: {length: 1.4}\n"), "left_upper_leg");
  // Upkie's own numbers; Σ = ∫ρxxᵀ.
  const double xx = 0.5 * (2.801218e-3 + 8.982728e-4 - 2.964107e-3);
  const double yy = 0.5 * (2.964107e-3 + 8.982728e-4 - 2.801218e-3);
  const double zz = 0.5 * (2.964107e-3 + 2.801218e-3 - 8.982728e-4);
  EXPECT_NEAR(after(0, 0), yy + f * f * zz, 1e-9);
  EXPECT_NEAR(after(1, 1), xx + f * f * zz, 1e-9);
  EXPECT_NEAR(after(2, 2), xx + yy, 1e-9);
  EXPECT_NEAR(after(1, 2), f * 7.402997e-4, 1e-9);
  EXPECT_NEAR(after(0, 1), 0.0, 1e-9);
}

TEST_F(RobotOfAnotherSize, MayHaveLegsThatDiffer) {
  const RobotModel robot =
      with("legs: {length: 2, left: {length: 1.015}, right: {length: 0.985}}\n");
  const MjDataPtr data = at_zero(robot);
  EXPECT_NEAR(anchor(robot, "left_wheel", *data).z(), -0.164 - 2.0 * 1.015 * 0.343, 1e-12);
  EXPECT_NEAR(anchor(robot, "right_wheel", *data).z(), -0.164 - 2.0 * 0.985 * 0.343, 1e-12);
}

TEST_F(RobotOfAnotherSize, OfItsOwnSizeIsTheMjcfItself) {
  for (const char* keys :
       {"", "mass: 1\nwheel_radius: 0.05\nlegs: {length: 1}\nstance: {hip: 0.1}\n"}) {
    const RobotModel same = with(keys);
    ASSERT_EQ(same.mj->nbuffer, upkie_.mj->nbuffer);
    EXPECT_EQ(
        std::memcmp(same.mj->buffer, upkie_.mj->buffer, static_cast<std::size_t>(same.mj->nbuffer)),
        0);
  }
}

TEST_F(RobotOfAnotherSize, IsDrawnInASceneOfTheSameSize) {
  for (const char* text : {"mass: 2\n", "actuators: {knee: {armature: 0.003}}\n"}) {
    const RobotModel robot = with(text);
    EXPECT_EQ(robot.mj->stat.extent, upkie_.mj->stat.extent);
    EXPECT_EQ(robot.mj->stat.center[2], upkie_.mj->stat.center[2]);
  }
}

TEST_F(RobotOfAnotherSize, HasItsStanceInItsFile) {
  (void)with("stance: {hip: 0.1, knee: 0.17}\n");
  const Stance stance = robot_description(folder_ / "robot.yaml").stance;
  EXPECT_EQ(stance.hip, 0.1);
  EXPECT_EQ(stance.knee, 0.17);
  EXPECT_EQ(robot_description(upkie_mjcf).stance.hip, 0.455);
}

TEST_F(RobotOfAnotherSize, HasTyresOfItsSizeInEveryStrip) {
  const RobotModel drawn = with("tyre: {law: spring_damper, width: 0.03}\n");
  const RobotModel large =
      with("wheel_radius: 0.08\nlegs: {length: 1.3}\ntyre: {law: spring_damper, width: 0.03}\n");
  EXPECT_EQ(large.wheel_radius, 0.08);
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    ASSERT_EQ(large.tyre_strips[wheel].size(), 3U);
    for (std::size_t strip = 0; strip < 3; ++strip) {
      const int here = large.tyre_strips[wheel][strip];
      EXPECT_NEAR(large.mj->geom_size[3 * here], 0.08, 1e-12);
      // Side by side as they were: neither wheels nor legs grow across.
      EXPECT_TRUE(
          vector_at(large.mj->geom_pos, here)
              .isApprox(vector_at(drawn.mj->geom_pos, drawn.tyre_strips[wheel][strip]), 1e-12));
    }
  }
}

}  // namespace
}  // namespace touchdown::models
