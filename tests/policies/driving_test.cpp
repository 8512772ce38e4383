#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "policies/commands.hpp"
#include "policies/wheel_balancer.hpp"
#include "tests/complaint.hpp"

namespace touchdown::policies {
namespace {

using ::testing::HasSubstr;

VelocityScript read(const std::string& text) {
  Fields fields(YamlDocument::parse(text, "script.yaml"));
  VelocityScript script;
  fields.list("velocity", script, script);
  fields.finish();
  return script;
}

std::string complaint(const std::string& text) {
  return complaint_of([&] { (void)read(text); });
}

TEST(VelocityScript, StandsBeforeTheFirstCommandAndKeepsTheLast) {
  const VelocityScript script = {{1.0, 0.5, 0.1}, {2.0, -0.5, 0.0}, {4.0, 0.0, 0.2}};
  EXPECT_EQ(command_at(script, 0.0).velocity, 0.0);
  EXPECT_EQ(command_at(script, 0.999).velocity, 0.0);
  EXPECT_EQ(command_at(script, 1.0).velocity, 0.5);
  EXPECT_EQ(command_at(script, 1.999).yaw_rate, 0.1);
  EXPECT_EQ(command_at(script, 2.0).velocity, -0.5);
  EXPECT_EQ(command_at(script, 1e9).yaw_rate, 0.2);
}

TEST(VelocityScript, AnEmptyOneStands) {
  EXPECT_EQ(command_at({}, 3.0).velocity, 0.0);
  EXPECT_EQ(command_at({}, 3.0).yaw_rate, 0.0);
  EXPECT_TRUE(read("{}").empty());
}

TEST(VelocityScript, SurvivesTheRoundTrip) {
  VelocityScript script = read(
      "velocity:\n  - {time: 0.1, velocity: 0.30000000000000004}\n  - {time: 2, yaw_rate: -0.7}\n");
  ASSERT_EQ(script.size(), 2U);
  Fields written;
  written.list("velocity", script, script);
  YAML::Emitter out;
  out.SetDoublePrecision(17);
  out << written.node();
  const VelocityScript again = read(out.c_str());
  ASSERT_EQ(again.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again[i].time, script[i].time);
    EXPECT_EQ(again[i].velocity, script[i].velocity);
    EXPECT_EQ(again[i].yaw_rate, script[i].yaw_rate);
  }
}

TEST(VelocityScript, ComplainsOnTheLine) {
  EXPECT_THAT(complaint("velocity:\n  - {time: 2}\n  - {time: 2}\n"),
              AllOf(HasSubstr("script.yaml:3:"), HasSubstr("later time")));
  EXPECT_THAT(complaint("velocity:\n  - {time: 2, velocty: 1}\n"),
              HasSubstr("did you mean 'velocity'"));
  EXPECT_THAT(complaint("velocity:\n  - {velocity: fast}\n"), HasSubstr("expected a number"));
  EXPECT_THAT(complaint("velocity:\n  - {velocity: 99}\n"), HasSubstr("velocity: expected"));
  EXPECT_THAT(complaint("velocity:\n  - {velocity: .nan}\n"), HasSubstr("velocity: expected"));
}

constexpr double control_period = 1e-3;

models::Observation crouched(double hip, double knee) {
  models::Observation seen;
  seen.servo[models::index(models::Servo::left_hip)].position = hip;
  seen.servo[models::index(models::Servo::left_knee)].position = -knee;
  seen.servo[models::index(models::Servo::right_hip)].position = -hip;
  seen.servo[models::index(models::Servo::right_knee)].position = knee;
  return seen;
}

/// Leg commands of a balancer, step by step.
std::vector<models::Action> followed(const CrouchScript& script, double hip, double knee,
                                     double seconds) {
  WheelBalancer policy({}, make_course({{}, script}, 0.05, control_period));
  models::Observation seen = crouched(hip, knee);
  policy.reset(seen);
  std::vector<models::Action> actions;
  for (int k = 0; k * control_period < seconds; ++k) {
    seen.time = k * control_period;
    actions.push_back(policy.act(seen));
  }
  return actions;
}

double target(const models::Action& action, models::Servo servo) {
  return action.servo[models::index(servo)].position;
}

TEST(CrouchScript, SlewsAtItsRateAndHolds) {
  const auto actions = followed({{0.5, 0.25, 0.3}, {2.0, 0.05, 0.1}}, 0.1, 0.17, 5.0);
  const auto hip = [&](double time) {
    return target(actions[static_cast<std::size_t>(std::lround(time / control_period))],
                  models::Servo::left_hip);
  };
  EXPECT_EQ(hip(0.499), 0.1);           // as at the reset
  EXPECT_NEAR(hip(0.75), 0.175, 1e-3);  // halfway of half a second
  EXPECT_NEAR(hip(0.999), 0.25, 1e-3);
  for (const double time : {1.1, 1.5, 1.999}) EXPECT_EQ(hip(time), 0.25);
  EXPECT_NEAR(hip(3.0), 0.15, 1e-3);  // on the way back, slower
  for (const double time : {4.1, 4.9}) EXPECT_NEAR(hip(time), 0.05, 1e-12);
  for (std::size_t k = 1; k < actions.size(); ++k) {
    const double step = target(actions[k], models::Servo::left_hip) -
                        target(actions[k - 1], models::Servo::left_hip);
    EXPECT_LE(step, 0.3 * control_period + 1e-12);
    EXPECT_GE(step, -0.1 * control_period - 1e-12);
  }
}

TEST(CrouchScript, BendsTheKneesInProportionAndBothLegsAlike) {
  const auto actions = followed({{0.0, 0.455, 1.0}}, 0.0, 0.0, 1.0);
  EXPECT_NEAR(target(actions.back(), models::Servo::left_knee), -0.791, 1e-9);
  for (const models::Action& action : actions) {
    const double hip = target(action, models::Servo::left_hip);
    EXPECT_NEAR(target(action, models::Servo::left_knee), -1.7385 * hip, 1e-4);
    EXPECT_NEAR(target(action, models::Servo::right_hip), -hip, 1e-12);
    EXPECT_NEAR(target(action, models::Servo::right_knee), 1.7385 * hip, 1e-4);
  }
}

TEST(CrouchScript, StartsFromTheKneesThatItFindsWithoutAJump) {
  const auto actions = followed({{0.0, 0.3, 0.5}}, 0.2, 0.1, 1.0);
  EXPECT_NEAR(target(actions.front(), models::Servo::right_knee), 0.1, 1e-3);
  EXPECT_NEAR(target(actions.back(), models::Servo::right_knee), 0.1 + 0.1 * knee_per_hip, 1e-9);
}

TEST(CrouchScript, AnEmptyOneKeepsThePostureToTheBit) {
  for (const models::Action& action : followed({}, 0.1234, 0.3456, 0.1)) {
    EXPECT_EQ(target(action, models::Servo::left_hip), 0.1234);
    EXPECT_EQ(target(action, models::Servo::right_knee), 0.3456);
  }
}

TEST(CrouchScript, BeginsAgainAfterAReset) {
  WheelBalancer policy({}, make_course({{}, {{0.0, 0.5, 100.0}}}, 0.05, control_period));
  const models::Observation seen = crouched(0.1, 0.2);
  for (int i = 0; i < 2; ++i) {
    policy.reset(seen);
    EXPECT_NEAR(target(policy.act(seen), models::Servo::left_hip), 0.2, 1e-12);
  }
}

std::string complaint_about_crouch(const std::string& text) {
  return complaint_of([&] {
    Fields fields(YamlDocument::parse(text, "script.yaml"));
    CrouchScript script;
    fields.list("crouch", script, script);
    fields.finish();
  });
}

TEST(CrouchScript, ComplainsOnTheLine) {
  EXPECT_EQ(complaint_about_crouch("crouch:\n  - {time: 2, hip: 0.3}\n"), "no complaint");
  EXPECT_THAT(complaint_about_crouch("crouch:\n  - {time: 2, hip: 0}\n  - {time: 2, hip: 0}\n"),
              AllOf(HasSubstr("script.yaml:3:"), HasSubstr("later time")));
  EXPECT_THAT(complaint_about_crouch("crouch:\n  - {time: 2}\n"),
              AllOf(HasSubstr("script.yaml:2:"), HasSubstr("hip: is missing")));
  EXPECT_THAT(complaint_about_crouch("crouch:\n  - {hip: 0.1, rat: 1}\n"),
              HasSubstr("did you mean 'rate'"));
  EXPECT_THAT(complaint_about_crouch("crouch:\n  - {hip: 7}\n"), HasSubstr("hip: expected"));
  EXPECT_THAT(complaint_about_crouch("crouch:\n  - {hip: 0, rate: 0}\n"),
              HasSubstr("rate: expected"));
}

}  // namespace
}  // namespace touchdown::policies
