#include "simulators/actuators.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/simulators/upkie.hpp"

namespace touchdown::simulators {
namespace {

using models::Actuator;
using models::Servo;

constexpr std::size_t left_wheel = models::index(Servo::left_wheel);

/// Without gravity, and with a base and left upper leg too heavy to move: only the left lower leg
/// and wheel move.
void hold_all_but_a_lower_leg(models::RobotModel& robot) {
  without_gravity(robot);
  const int lower = robot.mj->body_parentid[robot.mj->geom_bodyid[robot.tyre_geom[0]]];
  for (const int body : {robot.base_body, robot.mj->body_parentid[lower]}) make_heavy(robot, body);
}

/// Puts the wheel's centre of mass on its axle and returns its inertia about it (kg·m²).
double centred_wheel(models::RobotModel& robot) {
  const int body = robot.mj->geom_bodyid[robot.tyre_geom[0]];
  robot.mj->body_ipos[3 * body] = robot.mj->body_ipos[3 * body + 2] = 0.0;
  const Eigen::Matrix3d axes = models::quaternion_at(robot.mj->body_iquat, body).toRotationMatrix();
  const Eigen::Vector3d inertia = models::vector_at(robot.mj->body_inertia, body);
  return (axes * inertia.asDiagonal() * axes.transpose())(1, 1);
}

/// Sets the actuator of a servo, as compiling a robot file does.
void set(models::RobotModel& robot, std::size_t servo, const Actuator& actuator) {
  robot.actuator[servo] = actuator;
  robot.mj->dof_armature[robot.dof_address[servo]] = actuator.armature;
  robot.effort[servo] = std::min(robot.effort[servo], actuator.maximum_torque);
}

TEST(Servo, FollowsTheLaw) {
  constexpr double no_position = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  struct Case {
    const char* what;
    models::ServoCommand command;  // feedforward, position, velocity, kp, kd, maximum torque
    double position, velocity, effort, torque;
  };
  for (const Case& c : std::vector<Case>{
           {"no command", {0.0, no_position, 0.0, 1.0, 0.0}, 1.0, 2.0, 16.0, 0.0},
           {"by default it brakes", {}, 1.0, 2.0, 16.0, -2.0},
           {"feedforward adds", {3.0}, 0.0, 1.0, 16.0, 2.0},
           {"position", {0.0, 0.5}, 0.4, 0.0, 16.0, 2.0},
           {"position scaled", {0.0, 0.5, 0.0, 2.0}, 0.4, 0.0, 16.0, 4.0},
           {"no position", {0.0, no_position, 0.0, 2.0}, 0.4, 0.0, 16.0, 0.0},
           {"velocity", {0.0, no_position, 3.0}, 0.0, 1.0, 16.0, 2.0},
           {"velocity scaled", {0.0, no_position, 3.0, 1.0, 0.2}, 0.0, 1.0, 16.0, 0.4},
           {"all terms", {1.0, 0.1, 1.0, 0.5, 0.5}, 0.0, 3.0, 16.0, 1.0 + 0.5 * -2.0 + 10.0 * 0.1},
           {"the motor's limit", {99.0}, 0.0, 0.0, 1.7, 1.7},
           {"either way", {-99.0}, 0.0, 0.0, 1.7, -1.7},
           {"the command's limit", {99.0, no_position, 0.0, 1.0, 1.0, 0.5}, 0.0, 0.0, 1.7, 0.5},
           {"the smaller of both", {99.0, no_position, 0.0, 1.0, 1.0, 5.0}, 0.0, 0.0, 1.7, 1.7},
           {"a limit below zero is zero",
            {99.0, no_position, 0.0, 1.0, 1.0, -1.0},
            0.0,
            0.0,
            1.7,
            0.0},
           {"an infinite command", {0.0, no_position, infinity}, 0.0, 0.0, 16.0, 16.0}}) {
    EXPECT_NEAR(servo_torque(c.command, c.position, c.velocity, c.effort), c.torque, 1e-12)
        << c.what;
  }
}

class Actuated : public EveryEngine {
 protected:
  /// The left wheel alone, without gravity.
  std::unique_ptr<Simulator> wheel_with(const Actuator& actuator, double velocity = 0.0) {
    const auto model = upkie([&](models::RobotModel& robot) {
      hold_all_but_a_lower_leg(robot);
      inertia_ = centred_wheel(robot);
      // The lower leg is held too.
      const int leg = robot.mj->body_parentid[robot.mj->geom_bodyid[robot.tyre_geom[0]]];
      for (int axis = 0; axis < 3; ++axis) robot.mj->body_inertia[3 * leg + axis] = 1e7;
      set(robot, left_wheel, actuator);
    });
    auto simulator = make(model);
    RobotState start = at_height(5.0);
    start.joint_velocity[left_wheel] = velocity;
    simulator->reset(start);
    return simulator;
  }

  static void push(Simulator& simulator, double torque, int steps) {
    JointTorques all = {};
    all[left_wheel] = torque;
    for (int i = 0; i < steps; ++i) simulator.step(torques(all));
  }
  static double spin(const Simulator& simulator) {
    return simulator.state().joint_velocity[left_wheel];
  }

  double inertia_ = 0.0;
};

TEST_P(Actuated, WheelIsSlowedDownEvenlyByCoulombFriction) {
  const auto simulator = wheel_with({.friction = 0.01, .presliding_stiffness = 20.0}, 50.0);
  push(*simulator, 0.0, 200);  // presliding ends after some ten milliseconds
  const double before = spin(*simulator);
  push(*simulator, 0.0, 300);
  EXPECT_NEAR(before - spin(*simulator), 0.3 * 0.01 / inertia_, 1e-3 * 0.3 * 0.01 / inertia_);
}

TEST_P(Actuated, GearsLoseAShareOfTheirTorqueDrivingAndBraking) {
  // The share opposes the motion, so that it takes from a driving torque and adds to a braking one.
  for (const double torque : {0.2, -0.2}) {
    const auto simulator = wheel_with({.load_friction = 0.15, .presliding_stiffness = 20.0}, 200.0);
    push(*simulator, torque, 50);
    const double before = spin(*simulator);
    push(*simulator, torque, 50);
    const double expected = 0.05 * (torque - 0.15 * 0.2) / inertia_;
    EXPECT_NEAR(spin(*simulator) - before, expected, 2e-3 * std::abs(expected)) << torque;
    EXPECT_EQ(simulator->observation().servo[left_wheel].torque, torque) << "as reported";
  }
}

TEST_P(Actuated, RotorsCrossTheBacklashBeforeTheJointGetsTheirTorque) {
  // The torque turns the rotor alone across the play, in √(2bJ/τ), and then the wheel with it.
  constexpr double torque = 0.1, backlash = 0.01, armature = 0.002;
  const auto simulator = wheel_with({.armature = armature, .backlash = backlash});
  push(*simulator, -torque, 100);  // against the lower flank
  const double before = spin(*simulator);
  const double crossing = std::sqrt(2.0 * backlash * armature / torque);  // 20 ms
  push(*simulator, torque, 10);
  const auto& reported = simulator->observation().servo[left_wheel];
  EXPECT_NEAR(spin(*simulator), before, 1e-6) << "the wheel coasts";
  EXPECT_NEAR(reported.velocity - before, torque / armature * 0.01, 1e-9);
  push(*simulator, torque, 90);
  const double driven = 0.1 - crossing;  // s
  const double expected = torque * driven / (inertia_ + armature);
  EXPECT_NEAR(spin(*simulator) - before, expected, 0.03 * expected);
  EXPECT_NEAR(reported.position - simulator->state().joint_position[left_wheel], 0.5 * backlash,
              1e-9);
  EXPECT_NEAR(reported.velocity, spin(*simulator), 1e-9);
}

TEST_P(Actuated, RotorsWithoutInertiaCrossTheBacklashAtOnce) {
  const auto simulator = wheel_with({.backlash = 0.02}, 3.0);
  for (const double torque : {0.05, -0.05, 0.05}) {
    const double before = spin(*simulator);
    push(*simulator, torque, 20);
    const double expected = torque * 0.02 / inertia_;
    EXPECT_NEAR(spin(*simulator) - before, expected, 1e-3 * std::abs(expected));
    EXPECT_NEAR(simulator->observation().servo[left_wheel].position -
                    simulator->state().joint_position[left_wheel],
                std::copysign(0.01, torque), 1e-9);
  }
}

TEST_P(Actuated, WheelDoesNotCreepUnderLessThanItsFriction) {
  const Actuator actuator{.friction = 0.01, .presliding_stiffness = 20.0, .viscous = 1e-3};
  const auto simulator = wheel_with(actuator);
  push(*simulator, 0.008, 1000);
  const double settled = simulator->state().joint_position[left_wheel];
  EXPECT_NEAR(settled, 0.008 / 20.0, 1e-6) << "at the equilibrium of the presliding spring";
  push(*simulator, 0.008, 2000);
  EXPECT_NEAR(simulator->state().joint_position[left_wheel], settled, 1e-9);
  push(*simulator, 0.012, 1000);
  EXPECT_GT(spin(*simulator), 0.1) << "it moves under more than friction";
}

TEST_P(Actuated, WheelSlowsDownExponentiallyByViscousFriction) {
  const double viscous = 1e-3;
  const auto simulator = wheel_with({.viscous = viscous}, 30.0);
  push(*simulator, 0.0, 300);
  const double each = 1.0 - 1e-3 * viscous / inertia_;  // per explicit step
  EXPECT_NEAR(spin(*simulator), 30.0 * std::pow(each, 300), 1e-3 * 30.0);
  EXPECT_NEAR(spin(*simulator), 30.0 * std::exp(-0.3 * viscous / inertia_), 0.05);
}

TEST_P(Actuated, RotorAddsItsInertia) {
  const double rotor = 0.003;
  const auto simulator = wheel_with({.armature = rotor});
  push(*simulator, 0.5, 100);
  const double expected = 0.1 * 0.5 / (inertia_ + rotor);
  EXPECT_NEAR(spin(*simulator), expected, 1e-3 * expected);
}

TEST_P(Actuated, TorqueLagsBehindItsCommandAsAFirstOrderSystem) {
  const auto simulator = wheel_with({.torque_lag = 0.005, .torque_error = 0.0});
  for (int k = 1; k <= 20; ++k) {
    push(*simulator, 0.4, 1);
    EXPECT_NEAR(simulator->observation().servo[left_wheel].torque,
                0.4 * (1.0 - std::exp(-1e-3 * k / 0.005)), 1e-12);
  }
}

TEST_P(Actuated, CommandsAreDelayedByWholeSteps) {
  const auto simulator = wheel_with({.command_delay = 0.003});
  push(*simulator, 0.1, 10);
  for (int k = 0; k < 3; ++k) {
    push(*simulator, 0.2, 1);
    EXPECT_EQ(simulator->observation().servo[left_wheel].torque, 0.1);
  }
  push(*simulator, 0.2, 1);
  EXPECT_EQ(simulator->observation().servo[left_wheel].torque, 0.2);
  simulator->reset(at_height(5.0));
  push(*simulator, 0.3, 1);
  EXPECT_EQ(simulator->observation().servo[left_wheel].torque, 0.3) << "a reset clears the delay";
}

TEST_P(Actuated, ServoReportsItsTorqueAndTruthTheAppliedTorque) {
  const Actuator actuator{
      .maximum_torque = 0.5, .ripple = 0.02, .ripple_cycles = 7.0, .torque_error = 0.1};
  const auto simulator = wheel_with(actuator);
  double position = 0.0;
  for (int k = 0; k < 100; ++k) {
    position = simulator->state().joint_position[left_wheel];
    push(*simulator, 0.9, 1);
    EXPECT_EQ(simulator->observation().servo[left_wheel].torque, 0.5) << "saturated";
    ASSERT_TRUE(simulator->ground_truth().joint_torque);
    EXPECT_NEAR((*simulator->ground_truth().joint_torque)[left_wheel],
                0.55 + 0.02 * std::sin(7.0 * position), 1e-12);
  }
  EXPECT_GT(std::abs(position), 1.0);
}

TEST_P(Actuated, AnIdealActuatorHasNoSeparateTruth) {
  const auto simulator = wheel_with({});
  push(*simulator, 0.1, 3);
  EXPECT_FALSE(simulator->ground_truth().joint_torque);
}

TEST_P(Actuated, StiffPreslidingOfALightJointStaysStable) {
  const auto simulator = wheel_with({.friction = 0.05, .presliding_stiffness = 1e5}, 5.0);
  push(*simulator, 0.0, 3000);
  EXPECT_LT(std::abs(spin(*simulator)), 5.0);
  EXPECT_LT(std::abs(simulator->state().joint_position[left_wheel]), 1.0) << "at rest";
}

/// Sets every actuator of a robot without gravity.
void all_joints(models::RobotModel& robot, const Actuator& leg, const Actuator& of_wheel) {
  without_gravity(robot);
  for (std::size_t i = 0; i < models::servo_count; ++i) set(robot, i, i % 3 == 2 ? of_wheel : leg);
}

/// The largest difference between the engines' joint and base velocities under sine torques,
/// relative to the largest velocity.
double disagreement(const std::shared_ptr<const models::RobotModel>& model) {
  const SimulatorOptions options = steps_of(100);
  const auto mujoco = make_simulator("mujoco", model, options);
  const auto bullet = make_simulator("bullet", model, options);
  RobotState start = at_height(5.0);
  start.joint_position = {0.5, -0.4, 0.0, 0.3, 0.2, 0.0};
  mujoco->reset(start);
  bullet->reset(start);
  double difference = 0.0;
  double largest = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const double t = 1e-4 * i;
    const JointTorques all = {0.5 * std::sin(30.0 * t),  0.4 * std::cos(40.0 * t), 0.1,
                              -0.5 * std::sin(35.0 * t), 0.3 * std::cos(25.0 * t), -0.1};
    mujoco->step(torques(all));
    bullet->step(torques(all));
    for (std::size_t j = 0; j < models::servo_count; ++j) {
      largest = std::max(largest, std::abs(mujoco->state().joint_velocity[j]));
      difference = std::max(difference, std::abs(mujoco->state().joint_velocity[j] -
                                                 bullet->state().joint_velocity[j]));
    }
    difference = std::max(
        difference, (mujoco->state().angular_velocity - bullet->state().angular_velocity).norm());
  }
  return difference / largest;
}

TEST_P(Actuated, RobotOnStiffLegsStandsWithHeavyRotors) {
  const auto model = upkie([](models::RobotModel& robot) {
    for (std::size_t i = 0; i < models::servo_count; ++i) {
      if (i % 3 != 2) set(robot, i, {.armature = 0.003});
    }
  });
  for (const double hip : {0.0, 0.455}) {  // straight legs oscillate first
    const auto simulator = make(model);
    RobotState start = upright();
    start.joint_position = {hip, 1.7385 * hip, 0.0, -hip, -1.7385 * hip, 0.0};
    simulator->reset(start);
    double fastest = 0.0;
    for (int i = 0; i < 1500; ++i) {
      simulator->step(locked(start), guide(simulator->state()));
      if (i < 1000) continue;
      for (const double velocity : simulator->state().joint_velocity) {
        fastest = std::max(fastest, std::abs(velocity));
      }
    }
    EXPECT_LT(fastest, 0.05) << "hip at " << hip;
  }
}

TEST_P(Actuated, TheRobotReportsTheTorqueItApplied) {
  const auto simulator = make(upkie());
  simulator->reset(at_height(5.0));
  simulator->step(torques({1.0, -2.0, 9.0, -99.0, 0.5, -0.25}));
  const double expected[] = {1.0, -2.0, 1.7, -16.0, 0.5, -0.25};
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    EXPECT_EQ(simulator->observation().servo[i].torque, expected[i]) << models::servo_names[i];
  }
}

TEST_P(Actuated, TheLegsReachTheirCommandedPositions) {
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

TEST_P(Actuated, JointLimitsStopTheLegs) {
  const auto simulator = make(upkie(without_gravity));
  simulator->reset(at_height(5.0));
  for (int i = 0; i < 1000; ++i) simulator->step(torques({2.0, 0.0, 0.0, -2.0, 0.0, 0.0}));
  EXPECT_NEAR(simulator->state().joint_position[models::index(models::Servo::left_hip)], 1.26, 0.1);
  EXPECT_NEAR(simulator->state().joint_position[models::index(models::Servo::right_hip)], -1.26,
              0.1);
}

INSTANTIATE_TEST_SUITE_P(Engine, Actuated, ::testing::ValuesIn(simulator_names()), engine_name);

TEST(ActuatorParity, RotorsOfAFreeRobot) {
  const auto model = upkie([](models::RobotModel& robot) {
    all_joints(robot, {.armature = 0.003}, {.armature = 0.0002});
  });
  EXPECT_LT(disagreement(model), 1e-3);
}

TEST(ActuatorParity, FrictionLagDelayRippleAndErrorTogether) {
  const auto model = upkie([](models::RobotModel& robot) {
    all_joints(robot,
               {.friction = 0.06,
                .viscous = 0.01,
                .armature = 0.003,
                .torque_lag = 0.002,
                .command_delay = 0.001,
                .maximum_torque = 0.4,
                .ripple = 0.01,
                .ripple_cycles = 42.0,
                .torque_error = 0.05},
               {.friction = 0.01, .presliding_stiffness = 20.0});
  });
  EXPECT_LT(disagreement(model), 1e-3);
}

}  // namespace
}  // namespace touchdown::simulators
