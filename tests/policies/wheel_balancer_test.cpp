#include <cmath>
#include <type_traits>

#include <gtest/gtest.h>

#include "core/fields.hpp"
#include "policies/policy.hpp"

namespace touchdown::policies {
namespace {

using models::Action;
using models::Observation;
using models::Servo;

constexpr double radius = 0.05;
constexpr double period = 1e-3;

// What a policy gets is an observation, and there is no ground truth in one.
static_assert(std::is_same_v<decltype(&Policy::act), Action (Policy::*)(const Observation&)>);
static_assert(std::is_same_v<decltype(&Policy::reset), void (Policy::*)(const Observation&)>);

/// A balancer after its reset to `start`.
std::unique_ptr<Policy> balancer(const Observation& start = {}, const CourseScripts& scripts = {},
                                 const WheelBalancerConfig& gains = {}) {
  auto policy = make_wheel_balancer(
      {.gains = gains, .course = {std::make_shared<CourseScripts>(scripts), radius, period}});
  policy->reset(start);
  return policy;
}

const models::ServoCommand& command(const Action& action, Servo servo) {
  return action.servo[models::index(servo)];
}

/// Torque that each wheel servo would apply to a wheel at rest, along its forward direction.
std::array<double, 2> forward_torques(const Action& action) {
  const models::ServoCommand& left = command(action, Servo::left_wheel);
  const models::ServoCommand& right = command(action, Servo::right_wheel);
  return {left.feedforward_torque + left.kd_scale * left.velocity,
          -(right.feedforward_torque + right.kd_scale * right.velocity)};
}

Observation leaning(double pitch, double yaw = 0.0) {
  Observation seen;
  seen.pitch = pitch;
  seen.yaw = yaw;
  return seen;
}

/// An upright robot after its wheels have rolled forward by this angle (rad).
Observation rolled(double angle, double yaw = 0.0) {
  Observation seen = leaning(0.0, yaw);
  seen.servo[models::index(Servo::left_wheel)].position = angle;
  seen.servo[models::index(Servo::right_wheel)].position = -angle;
  return seen;
}

TEST(WheelBalancer, RollsTowardsTheSideToWhichItFalls) {
  EXPECT_EQ(forward_torques(balancer()->act({})), (std::array{0.0, 0.0}));
  for (const double pitch : {0.1, -0.1}) {
    const auto [left, right] = forward_torques(balancer()->act(leaning(pitch)));
    EXPECT_GT(left * pitch, 0.0);
    EXPECT_NEAR(left, right, 1e-12);
  }
}

TEST(WheelBalancer, RollsBackFirstWhenItIsToGoForward) {
  // To lean forward, the wheels have to come back: those of a robot 5 cm behind roll on.
  EXPECT_LT(forward_torques(balancer()->act(rolled(-1.0)))[0], 0.0);
}

TEST(WheelBalancer, TurnsTowardsItsCourse) {
  const auto [left, right] = forward_torques(balancer()->act(leaning(0.0, 0.2)));
  EXPECT_GT(left, 0.0) << "to the right when it points left";
  EXPECT_NEAR(left, -right, 1e-12);
  EXPECT_LT(forward_torques(balancer()->act(leaning(0.0, -0.2)))[0], 0.0);

  const auto policy = balancer();
  (void)policy->act(leaning(0.0, 0.3));
  (void)policy->act(rolled(10.0, 0.3));  // half a metre on, to the left
  const auto beside = forward_torques(policy->act(rolled(10.0)));
  EXPECT_GT(beside[0] - beside[1], 0.1) << "to the right when it is left of the course";
}

TEST(WheelBalancer, KeepsItsHeadingIfAskedBeyondHalfATurnToo) {
  EXPECT_GT(forward_torques(balancer(leaning(0.0, 0.4))->act(leaning(0.0, 0.4)))[0], 0.1);
  const auto keeps = balancer(leaning(0.0, 3.1), {}, {.keep_heading = true});
  EXPECT_EQ(forward_torques(keeps->act(leaning(0.0, 3.1)))[0], 0.0);
  // Turned left by 0.1, across the jump of the angle.
  const auto [left, right] = forward_torques(keeps->act(leaning(0.0, 3.2 - 2.0 * M_PI)));
  EXPECT_NEAR(left, 0.1, 1e-9);
  EXPECT_NEAR(right, -0.1, 1e-9);
}

TEST(WheelBalancer, IsAsNewAfterAReset) {
  const auto policy = balancer({}, {{{0.2, 0.5, 0.3}}, {}});
  const auto trace = [&] {  // of one second of a synthetic rocking motion
    std::vector<double> commands;
    policy->reset({});
    for (int i = 0; i < 1000; ++i) {
      Observation seen = leaning(0.05 * std::sin(0.01 * i), 0.1 * std::sin(0.003 * i));
      seen.time = i * period;
      seen.servo[models::index(Servo::left_wheel)] = {0.01 * i, 10.0 + std::sin(0.1 * i), 0.3};
      seen.servo[models::index(Servo::right_wheel)] = {-0.01 * i, -10.0, -0.2};
      const Action action = policy->act(seen);
      commands.push_back(command(action, Servo::left_wheel).velocity);
      commands.push_back(command(action, Servo::right_wheel).feedforward_torque);
    }
    return commands;
  };
  const std::vector<double> first = trace();
  EXPECT_EQ(trace(), first);
  EXPECT_NE(first.front(), first.back());
}

TEST(WheelBalancer, NeverAsksForMoreThanItsLimit) {
  const auto policy = balancer({}, {{{0.0, 3.0, 0.0}}, {}});
  double asked = 0.0;  // m/s
  for (int i = 0; i < 3000; ++i) {
    Observation seen = leaning(1.5);
    seen.time = i * period;
    asked = radius * command(policy->act(seen), Servo::left_wheel).velocity;
    ASSERT_LE(std::abs(asked), WheelBalancerConfig{}.max_velocity);
  }
  EXPECT_EQ(asked, WheelBalancerConfig{}.max_velocity);
}

TEST(WheelBalancer, HasGainsByNameThatItsOtherKeysOverride) {
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
  const WheelBalancerConfig upkie = read("gains: upkie");
  EXPECT_EQ((std::array{upkie.pitch_stiffness, upkie.pitch_damping, upkie.position_stiffness,
                        upkie.position_damping, upkie.max_velocity}),
            (std::array{20.0, 1.8, 1.6, 0.7, WheelBalancerConfig{}.max_velocity}));
  EXPECT_EQ(read("{gains: upkie, pitch_damping: 2}").pitch_damping, 2.0);
  EXPECT_EQ(read("gains: touchdown").pitch_damping, WheelBalancerConfig{}.pitch_damping);
  EXPECT_EQ(read("{pitch_stiffness: 5, gains: lqr}").pitch_stiffness, 5.0);
  // On top of a robot's own gains, a name replaces the four that it stands for.
  const WheelBalancerConfig own = read("gains: lqr");
  EXPECT_EQ(own.pitch_stiffness, 77.0);
  EXPECT_EQ(read("gains: touchdown", own).pitch_stiffness, 32.0);
  EXPECT_EQ(read("gains: touchdown", own).leg_kp_scale, 3.0);
  EXPECT_EQ(read("max_velocity: 1", own).pitch_stiffness, 77.0);
}

TEST(VelocityScript, StandsBeforeTheFirstCommandAndKeepsTheLast) {
  const VelocityScript script = {{1.0, 0.5, 0.1}, {2.0, -0.5, 0.0}, {4.0, 0.0, 0.2}};
  for (const auto& [time, velocity, yaw_rate] : {std::array{0.0, 0.0, 0.0},
                                                 {0.999, 0.0, 0.0},
                                                 {1.0, 0.5, 0.1},
                                                 {1.999, 0.5, 0.1},
                                                 {2.0, -0.5, 0.0},
                                                 {1e9, 0.0, 0.2}}) {
    EXPECT_EQ(command_at(script, time).velocity, velocity) << time;
    EXPECT_EQ(command_at(script, time).yaw_rate, yaw_rate) << time;
  }
  EXPECT_EQ(command_at({}, 3.0).velocity, 0.0);
}

Observation crouched(double hip, double knee) {
  Observation seen;
  seen.servo[models::index(Servo::left_hip)].position = hip;
  seen.servo[models::index(Servo::left_knee)].position = -knee;
  seen.servo[models::index(Servo::right_hip)].position = -hip;
  seen.servo[models::index(Servo::right_knee)].position = knee;
  return seen;
}

/// Actions of a balancer that starts crouched, step by step.
std::vector<Action> followed(const CrouchScript& script, double hip, double knee, double seconds) {
  Observation seen = crouched(hip, knee);
  const auto policy = balancer(seen, {{}, script});
  std::vector<Action> actions;
  for (int k = 0; k * period < seconds; ++k) {
    seen.time = k * period;
    actions.push_back(policy->act(seen));
  }
  return actions;
}

double target(const Action& action, Servo servo) { return command(action, servo).position; }

TEST(CrouchScript, SlewsAtItsRateAndHolds) {
  const auto actions = followed({{0.5, 0.25, 0.3}, {2.0, 0.05, 0.1}}, 0.1, 0.17, 5.0);
  const auto hip = [&](double time) {
    return target(actions[static_cast<std::size_t>(std::lround(time / period))], Servo::left_hip);
  };
  EXPECT_EQ(hip(0.499), 0.1);           // as at the reset
  EXPECT_NEAR(hip(0.75), 0.175, 1e-3);  // halfway of half a second
  EXPECT_NEAR(hip(0.999), 0.25, 1e-3);
  for (const double time : {1.1, 1.5, 1.999}) EXPECT_EQ(hip(time), 0.25);
  EXPECT_NEAR(hip(3.0), 0.15, 1e-3);  // on the way back, slower
  for (const double time : {4.1, 4.9}) EXPECT_NEAR(hip(time), 0.05, 1e-12);
  for (std::size_t k = 1; k < actions.size(); ++k) {
    const double step =
        target(actions[k], Servo::left_hip) - target(actions[k - 1], Servo::left_hip);
    EXPECT_LE(step, 0.3 * period + 1e-12);
    EXPECT_GE(step, -0.1 * period - 1e-12);
  }
}

TEST(CrouchScript, BendsTheKneesInProportionAndBothLegsAlike) {
  const auto actions = followed({{0.0, 0.455, 1.0}}, 0.0, 0.0, 1.0);
  EXPECT_NEAR(target(actions.back(), Servo::left_knee), -0.791, 1e-9);
  for (const Action& action : actions) {
    const double hip = target(action, Servo::left_hip);
    EXPECT_NEAR(target(action, Servo::left_knee), -1.7385 * hip, 1e-4);
    EXPECT_NEAR(target(action, Servo::right_hip), -hip, 1e-12);
    EXPECT_NEAR(target(action, Servo::right_knee), 1.7385 * hip, 1e-4);
  }
}

TEST(CrouchScript, StartsFromThePostureOfTheReset) {
  const auto actions = followed({{0.0, 0.3, 0.5}}, 0.2, 0.1, 1.0);
  EXPECT_NEAR(target(actions.front(), Servo::right_knee), 0.1, 1e-3) << "without a jump";
  EXPECT_NEAR(target(actions.back(), Servo::right_knee), 0.1 + 0.1 * knee_per_hip, 1e-9);
  for (const Action& action : followed({}, 0.1234, 0.3456, 0.1)) {  // to the bit without a script
    EXPECT_EQ(target(action, Servo::left_hip), 0.1234);
    EXPECT_EQ(target(action, Servo::right_knee), 0.3456);
    EXPECT_TRUE(std::isnan(target(action, Servo::left_wheel)));
  }
  const auto again = balancer({}, {{}, {{0.0, 0.5, 100.0}}});
  for (int i = 0; i < 2; ++i) {
    again->reset(crouched(0.1, 0.2));
    EXPECT_NEAR(target(again->act(crouched(0.1, 0.2)), Servo::left_hip), 0.2, 1e-12);
  }
}

}  // namespace
}  // namespace touchdown::policies
