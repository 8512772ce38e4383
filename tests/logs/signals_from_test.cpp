#include "logs/signals_from.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/logs/log/sample_recording.hpp"

namespace touchdown::logs {
namespace {

TEST(SignalsFrom, EveryJointLandsOnItsLeg) {
  const models::Observation o = test::sample_recording(1).observation[0];
  const Signals signals = signals_from(o, 0.25);
  EXPECT_EQ(signals.time, o.time);
  EXPECT_EQ(signals.leg[0].hip.position, o.servo[0].position);
  EXPECT_EQ(signals.leg[0].knee.torque, o.servo[1].torque);
  EXPECT_EQ(signals.leg[0].wheel.velocity, o.servo[2].velocity);
  EXPECT_EQ(signals.leg[1].hip.velocity, o.servo[3].velocity);
  EXPECT_EQ(signals.leg[1].knee.position, o.servo[4].position);
  EXPECT_EQ(signals.leg[1].wheel.torque, o.servo[5].torque);
  EXPECT_EQ(signals.linear_acceleration, o.imu.linear_acceleration);
  EXPECT_EQ(signals.angular_velocity, o.imu.angular_velocity);
  EXPECT_EQ(signals.ground_velocity_command, 0.25);
}

TEST(SignalsFrom, AccelerationIsProjectedUpwards) {
  models::Observation o;
  o.imu.orientation = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY());  // IMU upside down
  o.imu.linear_acceleration = {0.0, 0.0, 2.0};
  // The reference system's z points down; an IMU turned about y has its z up.
  EXPECT_NEAR(signals_from(o, 0.0).vertical_acceleration, 2.0, 1e-12);
}

TEST(SignalsFrom, AnInvalidQuaternionGivesNoVertical) {
  models::Observation o;
  o.imu.linear_acceleration = {0.0, 0.0, 2.0};
  for (const double length : {0.0, 1e-3, 0.5, 0.98, 1.02, 2.0, 1e200, HUGE_VAL, std::nan("")}) {
    o.imu.orientation = Eigen::Quaterniond(length, 0.0, 0.0, 0.0);
    EXPECT_TRUE(std::isnan(signals_from(o, 0.0).vertical_acceleration)) << length;
    EXPECT_EQ(signals_from(o, 0.0).linear_acceleration, o.imu.linear_acceleration);
  }
  for (const double length : {0.995, 1.0, 1.005}) {  // rounded to two digits
    o.imu.orientation = Eigen::Quaterniond(length, 0.0, 0.0, 0.0);
    EXPECT_NEAR(signals_from(o, 0.0).vertical_acceleration, -2.0, 0.05) << length;
  }
}

TEST(SignalsFrom, GroundVelocityIsTheMeanOfTheWheelsTargets) {
  models::Action action;
  action.servo[models::index(models::Servo::left_wheel)].velocity = 12.0;
  action.servo[models::index(models::Servo::right_wheel)].velocity = -8.0;
  EXPECT_DOUBLE_EQ(ground_velocity_command(action), 0.5);
  EXPECT_DOUBLE_EQ(ground_velocity_command(action, 0.1), 1.0);
}

TEST(SignalsFrom, TargetsAreThoseOfThePreviousAction) {
  const Recording recording = test::sample_recording(3);
  const models::Action& previous = recording.action[1];
  const Signals signals = signals_from(recording.observation[2], &previous);
  for (std::size_t side = 0; side < 2; ++side) {
    const LegTargets& leg = signals.target[side];
    std::size_t servo = 3 * side;
    for (const JointTarget* target : {&leg.hip, &leg.knee, &leg.wheel}) {
      const models::ServoCommand& command = previous.servo[servo++];
      if (std::isnan(command.position)) {
        EXPECT_TRUE(std::isnan(target->position));
      } else {
        EXPECT_EQ(target->position, command.position);
      }
      EXPECT_EQ(target->velocity, command.velocity);
      EXPECT_EQ(target->feedforward_torque, command.feedforward_torque);
      EXPECT_EQ(target->kp, 20.0 * command.kp_scale);  // as Upkie's spine sets them
      EXPECT_EQ(target->kd, command.kd_scale);
    }
  }
  EXPECT_EQ(signals.ground_velocity_command, ground_velocity_command(previous));
  const Signals first = signals_from(recording.observation[0], nullptr);
  EXPECT_EQ(first.ground_velocity_command, 0.0);
  EXPECT_TRUE(std::isnan(first.target[0].knee.position));
  EXPECT_TRUE(std::isnan(first.target[1].wheel.kp));
}

}  // namespace
}  // namespace touchdown::logs
