#include "policies/wheel_balancer.hpp"

#include <cmath>
#include <type_traits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "tests/complaint.hpp"

namespace touchdown::policies {
namespace {

using ::testing::HasSubstr;

constexpr double radius = 0.05;
constexpr double period = 1e-3;

// What a policy gets is an observation, and there is no ground truth in one.
static_assert(
    std::is_same_v<decltype(&Policy::act), models::Action (Policy::*)(const models::Observation&)>);
static_assert(
    std::is_same_v<decltype(&Policy::reset), void (Policy::*)(const models::Observation&)>);

WheelBalancer balancer(VelocityScript script = {}, WheelBalancerConfig config = {}) {
  return {config, make_course({std::move(script), {}}, radius, period)};
}

/// Torque that each wheel servo would apply to a wheel at rest, along its forward direction.
std::array<double, 2> forward_torques(const models::Action& action) {
  const models::ServoCommand& left = action.servo[models::index(models::Servo::left_wheel)];
  const models::ServoCommand& right = action.servo[models::index(models::Servo::right_wheel)];
  return {left.feedforward_torque + left.kd_scale * left.velocity,
          -(right.feedforward_torque + right.kd_scale * right.velocity)};
}

TEST(WheelBalancer, DoesNothingWhenUprightAndThere) {
  WheelBalancer policy = balancer();
  policy.reset({});
  const auto [left, right] = forward_torques(policy.act({}));
  EXPECT_EQ(left, 0.0);
  EXPECT_EQ(right, 0.0);
}

TEST(WheelBalancer, RollsTowardsTheSideItFallsTo) {
  for (const double pitch : {0.1, -0.1}) {
    WheelBalancer policy = balancer();
    policy.reset({});
    models::Observation seen;
    seen.pitch = pitch;
    const auto [left, right] = forward_torques(policy.act(seen));
    EXPECT_GT(left * pitch, 0.0);
    EXPECT_NEAR(left, right, 1e-12);
  }
}

TEST(WheelBalancer, RollsBackFirstWhenItIsToGoForward) {
  // To lean forward, the wheels have to come back; so with a robot ahead of its place, they go on.
  WheelBalancer policy = balancer();
  policy.reset({});
  models::Observation seen;
  seen.servo[models::index(models::Servo::left_wheel)].position = -1.0;  // 5 cm behind
  seen.servo[models::index(models::Servo::right_wheel)].position = 1.0;
  EXPECT_LT(forward_torques(policy.act(seen))[0], 0.0);
}

TEST(WheelBalancer, TurnsRightWhenItPointsLeftAndBack) {
  WheelBalancer policy = balancer();
  policy.reset({});
  models::Observation seen;
  seen.yaw = 0.2;
  const auto [left, right] = forward_torques(policy.act(seen));
  EXPECT_GT(left, 0.0);
  EXPECT_NEAR(left, -right, 1e-12);
  seen.yaw = -0.2;
  policy.reset({});
  EXPECT_LT(forward_torques(policy.act(seen))[0], 0.0);
}

TEST(WheelBalancer, TurnsRightWhenItIsLeftOfTheCourse) {
  WheelBalancer policy = balancer();
  policy.reset({});
  models::Observation seen;
  seen.yaw = 0.3;
  (void)policy.act(seen);
  seen.servo[models::index(models::Servo::left_wheel)].position =
      10.0;  // half a metre on, to the left
  seen.servo[models::index(models::Servo::right_wheel)].position = -10.0;
  (void)policy.act(seen);
  seen.yaw = 0.0;
  const auto [left, right] = forward_torques(policy.act(seen));
  EXPECT_GT(left - right, 0.1);
}

TEST(WheelBalancer, TurnsToTheCourseUnlessItKeepsItsHeading) {
  models::Observation askew;
  askew.yaw = 0.4;
  WheelBalancer comes_round = balancer();
  comes_round.reset(askew);
  EXPECT_GT(forward_torques(comes_round.act(askew))[0], 0.1);
  WheelBalancer keeps = balancer({}, {.keep_heading = true});
  keeps.reset(askew);
  EXPECT_EQ(forward_torques(keeps.act(askew))[0], 0.0);
}

TEST(WheelBalancer, AHeadingBeyondHalfATurnIsNotASurprise) {
  WheelBalancer policy = balancer({}, {.keep_heading = true});
  models::Observation seen;
  seen.yaw = 3.1;
  policy.reset(seen);
  seen.yaw = 3.2 - 2.0 * M_PI;  // turned left by 0.1, across the jump
  const auto [left, right] = forward_torques(policy.act(seen));
  EXPECT_NEAR(left, 0.1, 1e-9);
  EXPECT_NEAR(right, -0.1, 1e-9);
}

TEST(WheelBalancer, HoldsThePostureOfTheReset) {
  WheelBalancer policy = balancer();
  models::Observation crouched;
  crouched.servo[models::index(models::Servo::left_hip)].position = 0.4;
  crouched.servo[models::index(models::Servo::left_knee)].position = -0.7;
  policy.reset(crouched);
  const models::Action action = policy.act({});
  EXPECT_EQ(action.servo[models::index(models::Servo::left_hip)].position, 0.4);
  EXPECT_EQ(action.servo[models::index(models::Servo::left_knee)].position, -0.7);
  EXPECT_EQ(action.servo[models::index(models::Servo::right_knee)].position, 0.0);
  EXPECT_TRUE(std::isnan(action.servo[models::index(models::Servo::left_wheel)].position));
}

/// The commands over one second of a synthetic rocking motion.
std::vector<double> commands(WheelBalancer& policy) {
  std::vector<double> trace;
  policy.reset({});
  for (int i = 0; i < 1000; ++i) {
    models::Observation seen;
    seen.time = i * period;
    seen.pitch = 0.05 * std::sin(0.01 * i);
    seen.yaw = 0.1 * std::sin(0.003 * i);
    seen.servo[models::index(models::Servo::left_wheel)] = {0.01 * i, 10.0 + std::sin(0.1 * i),
                                                            0.3};
    seen.servo[models::index(models::Servo::right_wheel)] = {-0.01 * i, -10.0, -0.2};
    const models::Action action = policy.act(seen);
    trace.push_back(action.servo[models::index(models::Servo::left_wheel)].velocity);
    trace.push_back(action.servo[models::index(models::Servo::right_wheel)].feedforward_torque);
  }
  return trace;
}

TEST(WheelBalancer, IsAsNewAfterAReset) {
  WheelBalancer policy = balancer({{0.2, 0.5, 0.3}});
  const std::vector<double> first = commands(policy);
  EXPECT_EQ(commands(policy), first);
  EXPECT_NE(first.front(), first.back());
}

TEST(WheelBalancer, NeverAsksForMoreThanItsLimit) {
  WheelBalancer policy = balancer({{0.0, 3.0, 0.0}});
  policy.reset({});
  for (int i = 0; i < 3000; ++i) {
    models::Observation seen;
    seen.time = i * period;
    seen.pitch = 1.5;
    (void)policy.act(seen);
    ASSERT_LE(std::abs(policy.ground_velocity_command()), WheelBalancerConfig{}.max_velocity);
  }
  EXPECT_EQ(policy.ground_velocity_command(), WheelBalancerConfig{}.max_velocity);
}

TEST(WheelBalancer, ReadsItsGainsStrictly) {
  const auto read = [](const std::string& text) {
    return from_yaml<WheelBalancerConfig>(YamlDocument::parse(text, "gains.yaml"));
  };
  const WheelBalancerConfig config = read("{pitch_damping: 3, keep_heading: true}");
  EXPECT_EQ(config.pitch_damping, 3.0);
  EXPECT_TRUE(config.keep_heading);
  EXPECT_EQ(config.pitch_stiffness, WheelBalancerConfig{}.pitch_stiffness);
  EXPECT_EQ(YAML::Dump(to_node(read(YAML::Dump(to_node(config))))), YAML::Dump(to_node(config)));
  EXPECT_THAT(complaint_of([&] { (void)read("pitch_stifness: 3"); }),
              HasSubstr("did you mean 'pitch_stiffness'?"));
}

TEST(WheelBalancer, HasUpkiesGainsByName) {
  const auto read = [](const std::string& text) {
    return from_yaml<WheelBalancerConfig>(YamlDocument::parse(text, "gains.yaml"));
  };
  const WheelBalancerConfig upkie = read("gains: upkie");
  EXPECT_EQ(upkie.pitch_stiffness, 20.0);
  EXPECT_EQ(upkie.pitch_damping, 1.8);
  EXPECT_EQ(upkie.position_stiffness, 1.6);
  EXPECT_EQ(upkie.position_damping, 0.7);
  EXPECT_EQ(upkie.max_velocity, WheelBalancerConfig{}.max_velocity);
  EXPECT_EQ(read("{gains: upkie, pitch_damping: 2}").pitch_damping, 2.0);
  EXPECT_EQ(read("gains: touchdown").pitch_damping, WheelBalancerConfig{}.pitch_damping);
  // What is written are the numbers.
  EXPECT_EQ(YAML::Dump(to_node(read(YAML::Dump(to_node(upkie))))), YAML::Dump(to_node(upkie)));
  EXPECT_THAT(YAML::Dump(to_node(upkie)), ::testing::Not(HasSubstr("gains")));
  EXPECT_THAT(complaint_of([&] { (void)read("gains: upki"); }),
              AllOf(HasSubstr("gains.yaml:1:"), HasSubstr("upkie")));
}

TEST(WheelBalancer, HasLqrGainsByNameWhereTheRobotIsKnown) {
  const auto read = [](const std::string& text, WheelBalancerConfig config = {}) {
    Fields fields(YamlDocument::parse(text, "gains.yaml"));
    describe(fields, config, [](WheelBalancerConfig robot) {
      robot.pitch_stiffness = 77.0;
      robot.leg_kp_scale = 3.0;
      return robot;
    });
    fields.finish();
    return config;
  };
  EXPECT_EQ(read("gains: lqr").pitch_stiffness, 77.0);
  EXPECT_EQ(read("{pitch_stiffness: 5, gains: lqr}").pitch_stiffness, 5.0);
  EXPECT_EQ(read("max_velocity: 1").pitch_stiffness, WheelBalancerConfig{}.pitch_stiffness);
  // On top of a robot's own gains, a name replaces the four that it stands for.
  const WheelBalancerConfig own = read("gains: lqr");
  EXPECT_EQ(read("gains: touchdown", own).pitch_stiffness, 32.0);
  EXPECT_EQ(read("gains: touchdown", own).leg_kp_scale, 3.0);
  EXPECT_EQ(read("max_velocity: 1", own).pitch_stiffness, 77.0);
}

}  // namespace
}  // namespace touchdown::policies
