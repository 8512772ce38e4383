#include "policies/forces.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "tests/complaint.hpp"

namespace touchdown::policies {
namespace {

using ::testing::HasSubstr;

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

TEST(ForceScript, ActsFromItsTimeForItsDuration) {
  const TimedForce force = {.time = 1.0, .duration = 0.5};
  EXPECT_FALSE(force.acts_at(0.999));
  EXPECT_TRUE(force.acts_at(1.0));
  EXPECT_TRUE(force.acts_at(1.499));
  EXPECT_FALSE(force.acts_at(1.5));
}

TEST(ForceScript, GrowsAndFadesWithinItsDuration) {
  const TimedForce force = {
      .time = 1.0, .duration = 4.0, .rise = 1.0, .fall = 2.0, .force = {0.0, 0.0, 8.0}};
  expect_near(force_in_world(force, 0.9, 0.0), {0.0, 0.0, 0.0});
  expect_near(force_in_world(force, 1.25, 0.0), {0.0, 0.0, 2.0});
  expect_near(force_in_world(force, 2.0, 0.0), {0.0, 0.0, 8.0});
  expect_near(force_in_world(force, 3.0, 0.0), {0.0, 0.0, 8.0});
  expect_near(force_in_world(force, 4.5, 0.0), {0.0, 0.0, 2.0});
  expect_near(force_in_world(force, 5.0, 0.0), {0.0, 0.0, 0.0});
}

TEST(ForceScript, TurnsWithTheRobotWhenAsked) {
  TimedForce force = {.force = {3.0, 1.0, 2.0}};
  expect_near(force_in_world(force, 0.0, 1.0), {3.0, 1.0, 2.0});
  force.along_heading = true;
  expect_near(force_in_world(force, 0.0, M_PI / 2.0), {-1.0, 3.0, 2.0});
}

ForceScript forces(const std::string& text) {
  ForceScript script;
  Fields(YamlDocument::parse(text, "forces.yaml")).list("forces", script);
  return script;
}

TEST(ForceScript, SurvivesTheRoundTrip) {
  ForceScript script = forces(
      "forces:\n  - {time: 1.5, duration: 0.3, force: [1, 2.5, -3], point_in_base: [0, 0, 0.06], "
      "along_heading: true}\n  - {time: 0}\n");
  Fields written;
  written.list("forces", script);
  const ForceScript again = forces(YAML::Dump(written.node()));
  ASSERT_EQ(again.size(), 2U);
  EXPECT_EQ(again[0].time, 1.5);
  EXPECT_EQ(again[0].duration, 0.3);
  EXPECT_EQ(again[0].force, Eigen::Vector3d(1.0, 2.5, -3.0));
  EXPECT_EQ(again[0].point_in_base, Eigen::Vector3d(0.0, 0.0, 0.06));
  EXPECT_TRUE(again[0].along_heading);
  EXPECT_EQ(again[1].force, Eigen::Vector3d::Zero());
}

TEST(ForceScript, ComplainsOnTheLine) {
  EXPECT_THAT(complaint_of([] { (void)forces("forces:\n  - {force: [1, 2]}\n"); }),
              AllOf(HasSubstr("forces.yaml:2:"), HasSubstr("three numbers")));
  EXPECT_THAT(complaint_of([] { (void)forces("forces:\n  - {force: [1, 2, .inf]}\n"); }),
              HasSubstr("forces.0.force: expected a finite number"));
  EXPECT_THAT(complaint_of([] { (void)forces("forces:\n  - {fource: [1, 2, 3]}\n"); }),
              HasSubstr("did you mean 'force'"));
  EXPECT_THAT(complaint_of([] { (void)forces("forces:\n  - {duration: -1}\n"); }),
              HasSubstr("duration: expected"));
}

TEST(Tether, ReadsWhatItWrites) {
  Tether tether = rope();
  tether.anchor = {0.1, -0.2, 2.5};
  const Tether again =
      from_yaml<Tether>(YamlDocument::parse(YAML::Dump(to_node(tether)), "tether.yaml"));
  EXPECT_EQ(again.anchor, tether.anchor);
  EXPECT_EQ(again.point_in_base, tether.point_in_base);
  EXPECT_EQ(again.length, 1.0);
  EXPECT_EQ(again.stiffness, 1000.0);
  EXPECT_EQ(again.damping, 50.0);
  EXPECT_THAT(complaint_of(
                  [] { (void)from_yaml<Tether>(YamlDocument::parse("lenght: 1", "tether.yaml")); }),
              HasSubstr("tether.yaml:1:1: lenght: unknown key (did you mean 'length'?)"));
}

TEST(Guide, ReadsWhatItWrites) {
  const Guide guide = {1.0, 2.0, {0.1, 0.2, 0.3}, 4.0, 5.0};
  const Guide again =
      from_yaml<Guide>(YamlDocument::parse(YAML::Dump(to_node(guide)), "guide.yaml"));
  EXPECT_EQ(again.x, 1.0);
  EXPECT_EQ(again.y, 2.0);
  EXPECT_EQ(again.point_in_base, guide.point_in_base);
  EXPECT_EQ(again.stiffness, 4.0);
  EXPECT_EQ(again.damping, 5.0);
}

}  // namespace
}  // namespace touchdown::policies
