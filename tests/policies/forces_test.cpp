#include "policies/forces.hpp"

#include <gtest/gtest.h>

namespace touchdown::policies {
namespace {

void expect_near(const Eigen::Vector3d& value, const Eigen::Vector3d& expected) {
  EXPECT_LT((value - expected).norm(), 1e-9)
      << value.transpose() << " instead of " << expected.transpose();
}

/// A tether from 2 m above the origin, holding the base's origin.
Tether rope() {
  return {.anchor = {0.0, 0.0, 2.0},
          .point_in_base = Eigen::Vector3d::Zero(),
          .length = 1.0,
          .stiffness = 1000.0,
          .damping = 50.0};
}

models::GroundTruth robot_at(const Eigen::Vector3d& position) {
  models::GroundTruth robot;
  robot.base_position = position;
  return robot;
}

TEST(Tether, IsNothingWhileSlack) {
  EXPECT_EQ(tether_force(rope(), robot_at({0.0, 0.0, 1.5})), Eigen::Vector3d::Zero());
  models::GroundTruth leaving = robot_at({0.0, 0.0, 1.01});
  leaving.base_linear_velocity = {0.0, 0.0, -9.0};
  EXPECT_EQ(tether_force(rope(), leaving), Eigen::Vector3d::Zero());
  EXPECT_EQ(tether_force(rope(), robot_at({0.0, 0.0, 2.0})), Eigen::Vector3d::Zero());
}

TEST(Tether, PullsAlongTheRopeByStretchAndLengthening) {
  expect_near(tether_force(rope(), robot_at({0.0, 0.0, 0.9})), {0.0, 0.0, 100.0});
  // 3-4-5: 1.25 m from the anchor.
  expect_near(tether_force(rope(), robot_at({0.75, 0.0, 1.0})), {-250.0 * 0.6, 0.0, 250.0 * 0.8});
  models::GroundTruth falling = robot_at({0.0, 0.0, 0.9});
  falling.base_linear_velocity = {5.0, 0.0, -1.0};  // only the way along the rope counts
  expect_near(tether_force(rope(), falling), {0.0, 0.0, 100.0 + 50.0});
}

TEST(Tether, NeverPushes) {
  models::GroundTruth rising = robot_at({0.0, 0.0, 0.9});
  rising.base_linear_velocity = {0.0, 0.0, 10.0};  // the damper alone would push by 500 N
  EXPECT_EQ(tether_force(rope(), rising), Eigen::Vector3d::Zero());
}

TEST(Tether, HoldsAPointThatTurnsWithTheRobot) {
  Tether tether = rope();
  tether.point_in_base = {0.0, 0.0, 0.2};
  models::GroundTruth robot = robot_at({0.2, 0.0, 0.8});
  robot.base_orientation = Eigen::AngleAxisd(-M_PI / 2.0, Eigen::Vector3d::UnitY());
  // The point is straight below the anchor, and moves down by the turning.
  robot.base_angular_velocity = {0.0, -2.0, 0.0};
  expect_near(tether_force(tether, robot), {0.0, 0.0, 200.0 + 50.0 * 2.0 * 0.2});
}

TEST(Guide, IsALevelSpringAndDamper) {
  const Guide guide = {.x = 1.0,
                       .y = -1.0,
                       .point_in_base = Eigen::Vector3d::Zero(),
                       .stiffness = 100.0,
                       .damping = 10.0};
  models::GroundTruth robot = robot_at({1.5, -1.0, 7.0});
  expect_near(guide_force(guide, robot), {-50.0, 0.0, 0.0});
  robot.base_linear_velocity = {1.0, 2.0, 3.0};
  expect_near(guide_force(guide, robot), {-60.0, -20.0, 0.0});
}

TEST(ForceScript, GrowsAndFadesWithinItsDuration) {
  const TimedForce constant = {.time = 1.0, .duration = 0.5};
  for (const double time : {1.0, 1.499}) EXPECT_TRUE(constant.acts_at(time));
  for (const double time : {0.999, 1.5}) EXPECT_FALSE(constant.acts_at(time));
  const TimedForce force = {
      .time = 1.0, .duration = 4.0, .rise = 1.0, .fall = 2.0, .force = {0.0, 0.0, 8.0}};
  for (const auto& [time, up] :
       {std::pair{0.9, 0.0}, {1.25, 2.0}, {2.0, 8.0}, {3.0, 8.0}, {4.5, 2.0}, {5.0, 0.0}}) {
    expect_near(force_in_world(force, time, 0.0), {0.0, 0.0, up});
  }
}

TEST(ForceScript, TurnsWithTheRobotWhenAsked) {
  TimedForce force = {.force = {3.0, 1.0, 2.0}};
  expect_near(force_in_world(force, 0.0, 1.0), {3.0, 1.0, 2.0});
  force.along_heading = true;
  expect_near(force_in_world(force, 0.0, M_PI / 2.0), {-1.0, 3.0, 2.0});
}

}  // namespace
}  // namespace touchdown::policies
