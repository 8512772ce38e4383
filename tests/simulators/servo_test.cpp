#include "simulators/actuators.hpp"
#include "tests/simulators/upkie.hpp"

namespace touchdown::simulators {
namespace {

constexpr double no_position = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Case {
  const char* what;
  models::ServoCommand command;
  double position, velocity, effort, torque;
};

TEST(Servo, FollowsTheLaw) {
  const Case table[] = {
      {"no command", {.kd_scale = 0.0}, 1.0, 2.0, 16.0, 0.0},
      {"by default it brakes", {}, 1.0, 2.0, 16.0, -2.0},
      {"feedforward adds", {.feedforward_torque = 3.0}, 0.0, 1.0, 16.0, 2.0},
      {"position", {.position = 0.5}, 0.4, 0.0, 16.0, 2.0},
      {"position scaled", {.position = 0.5, .kp_scale = 2.0}, 0.4, 0.0, 16.0, 4.0},
      {"no position", {.position = no_position, .kp_scale = 2.0}, 0.4, 0.0, 16.0, 0.0},
      {"velocity", {.velocity = 3.0}, 0.0, 1.0, 16.0, 2.0},
      {"velocity scaled", {.velocity = 3.0, .kd_scale = 0.2}, 0.0, 1.0, 16.0, 0.4},
      {"all terms",
       {.feedforward_torque = 1.0,
        .position = 0.1,
        .velocity = 1.0,
        .kp_scale = 0.5,
        .kd_scale = 0.5},
       0.0,
       3.0,
       16.0,
       1.0 + 0.5 * -2.0 + 10.0 * 0.1},
      {"the motor's limit", {.feedforward_torque = 99.0}, 0.0, 0.0, 1.7, 1.7},
      {"either way", {.feedforward_torque = -99.0}, 0.0, 0.0, 1.7, -1.7},
      {"the command's limit",
       {.feedforward_torque = 99.0, .maximum_torque = 0.5},
       0.0,
       0.0,
       1.7,
       0.5},
      {"the smaller of both",
       {.feedforward_torque = 99.0, .maximum_torque = 5.0},
       0.0,
       0.0,
       1.7,
       1.7},
      {"a limit below zero is zero",
       {.feedforward_torque = 99.0, .maximum_torque = -1.0},
       0.0,
       0.0,
       1.7,
       0.0},
      {"an infinite command", {.velocity = infinity}, 0.0, 0.0, 16.0, 16.0},
  };
  for (const Case& c : table) {
    EXPECT_NEAR(servo_torque(c.command, c.position, c.velocity, c.effort), c.torque, 1e-12)
        << c.what;
  }
}

class ServoOf : public EveryEngine {};

TEST_P(ServoOf, TheRobotReportsTheTorqueItApplied) {
  const auto simulator = make(upkie());
  simulator->reset(at_height(5.0));
  simulator->step(torques({1.0, -2.0, 9.0, -99.0, 0.5, -0.25}));
  const double expected[] = {1.0, -2.0, 1.7, -16.0, 0.5, -0.25};
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    EXPECT_EQ(simulator->observation().servo[i].torque, expected[i]) << models::servo_names[i];
  }
}

TEST_P(ServoOf, TheLegsReachTheirCommandedPositions) {
  const auto simulator = make(upkie(without_gravity));
  simulator->reset(at_height(5.0));
  models::Action action = torques();
  const double target[] = {0.4, -0.7, 0.0, -0.4, 0.7, 0.0};
  for (const std::size_t i : {0U, 1U, 3U, 4U}) {
    action.servo[i] = {.position = target[i]};
  }
  for (int i = 0; i < 4000; ++i) simulator->step(action);
  for (const std::size_t i : {0U, 1U, 3U, 4U}) {
    EXPECT_NEAR(simulator->state().joint_position[i], target[i], 1e-3) << models::servo_names[i];
  }
}

TEST_P(ServoOf, JointLimitsStopTheLegs) {
  const auto simulator = make(upkie(without_gravity));
  simulator->reset(at_height(5.0));
  for (int i = 0; i < 1000; ++i) simulator->step(torques({2.0, 0.0, 0.0, -2.0, 0.0, 0.0}));
  EXPECT_NEAR(simulator->state().joint_position[models::index(models::Servo::left_hip)], 1.26, 0.1);
  EXPECT_NEAR(simulator->state().joint_position[models::index(models::Servo::right_hip)], -1.26,
              0.1);
}

INSTANTIATE_TEST_SUITE_P(Engine, ServoOf, ::testing::ValuesIn(simulator_names()), engine_name);

}  // namespace
}  // namespace touchdown::simulators
