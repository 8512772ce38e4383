#include "estimator/force/servo_law.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(ServoTorque, IsTheLawOfTheServo) {
  // 40 (0.5 − 0.4) + 2 (0.1 − 0.3) + 0.25
  const JointSignals joint = {0.4, 0.3, 99.0};
  EXPECT_NEAR(servo_torque(joint, {0.5, 0.1, 0.25, 40.0, 2.0}, {}), 3.85, 1e-12);
  EXPECT_NEAR(servo_torque(joint, {0.5, 0.1, 0.25, 40.0, 0.0}, {}), 4.25, 1e-12);
}

TEST(ServoTorque, IsUnknownWithoutGainOrTarget) {
  const JointSignals joint = {0.4, 0.3, 1.0};
  const JointTarget target = {0.5, 0.1, 0.25, 40.0, 2.0};
  ASSERT_TRUE(std::isfinite(servo_torque(joint, target, {})));
  for (double JointTarget::*member :
       {&JointTarget::position, &JointTarget::velocity, &JointTarget::feedforward_torque,
        &JointTarget::kp, &JointTarget::kd}) {
    for (const double bad : {nan, HUGE_VAL, -HUGE_VAL, 1e300, -1e300}) {
      JointTarget other = target;
      other.*member = bad;
      EXPECT_TRUE(std::isnan(servo_torque(joint, other, {}))) << bad;
    }
  }
  for (const double kp : {0.0, -0.0, -1.0}) {
    JointTarget other = target;
    other.kp = kp;
    EXPECT_TRUE(std::isnan(servo_torque(joint, other, {}))) << kp;
  }
  for (const double bad : {nan, HUGE_VAL, 1e300}) {
    EXPECT_TRUE(std::isnan(servo_torque({bad, 0.3, 1.0}, target, {})));
    EXPECT_TRUE(std::isnan(servo_torque({0.4, bad, 1.0}, target, {})));
  }
  EXPECT_TRUE(std::isnan(servo_torque(joint, {}, {})));
}

/// A leg in some pose, and targets that give its torques by the law.
struct HeldLeg {
  LegSignals leg;
  LegTargets target;
};

HeldLeg held_leg(test::Normal& normal) {
  HeldLeg held;
  const auto joint = [&](JointSignals& signals, JointTarget& target, double pose) {
    signals = {pose + 0.1 * normal(), normal(), 3.0 * normal()};
    target.kp = 10.0 + 50.0 * std::abs(normal());
    target.kd = std::abs(normal());
    target.velocity = normal();
    target.feedforward_torque = normal();
    target.position = signals.position + (signals.torque - target.feedforward_torque -
                                          target.kd * (target.velocity - signals.velocity)) /
                                             target.kp;
  };
  joint(held.leg.hip, held.target.hip, 0.4);
  joint(held.leg.knee, held.target.knee, -0.8);
  return held;
}

TEST(ServoLoad, WithoutFrictionIsTheLoadOfTheTorques) {
  test::Normal normal(1);
  for (int round = 0; round < 50; ++round) {
    const auto [leg, target] = held_leg(normal);
    for (const bool mirrored : {false, true}) {
      const FootJacobian foot = foot_jacobian({}, leg, mirrored);
      const double acceleration = 5.0 * normal();
      EXPECT_NEAR(
          servo_load({}, foot, leg, target, mirrored, acceleration, {}).force_times_determinant,
          vertical_force_times_determinant({}, foot, leg, mirrored, acceleration), 1e-9);
    }
  }
}

TEST(ServoLoad, IsBlindBelowFrictionAndShrinksByItAbove) {
  LegGeometry geometry;
  geometry.hip_friction = 0.2;
  geometry.knee_friction = 0.1;
  // In free fall nothing but the servos loads the joints.
  constexpr double free_fall = -9.81;
  LegSignals leg;
  leg.hip.position = 0.3;
  leg.knee.position = -0.7;
  const FootJacobian foot = foot_jacobian(geometry, leg, false);
  const auto load_of = [&](double hip, double knee) {
    LegTargets target;
    target.hip = {leg.hip.position + hip / 40.0, 0.0, 0.0, 40.0, 2.0};
    target.knee = {leg.knee.position + knee / 40.0, 0.0, 0.0, 40.0, 2.0};
    return servo_load(geometry, foot, leg, target, false, free_fall, {}).force_times_determinant;
  };
  for (const double share : {-0.99, -0.5, 0.0, 0.5, 0.99}) {
    EXPECT_NEAR(load_of(share * 0.2, -share * 0.1), 0.0, 1e-12);
  }
  for (const double sign : {-1.0, 1.0}) {
    leg.hip.torque = sign * 1.8;
    leg.knee.torque = sign * 0.9;
    EXPECT_NEAR(load_of(sign * 2.0, sign * 1.0),
                vertical_force_times_determinant(geometry, foot, leg, false, free_fall), 1e-12);
  }
}

TEST(ServoLoad, HasTheNoiseOfTheResolution) {
  // The standard deviation of rounding to steps of r, by trial.
  LegGeometry geometry;
  geometry.position_resolution = 1e-3;
  test::Normal normal(2);
  double squares = 0.0;
  constexpr int trials = 20'000;
  for (int i = 0; i < trials; ++i) {
    const double position = normal();
    const double error = 1e-3 * std::nearbyint(position / 1e-3) - position;
    squares += 30.0 * error * 30.0 * error / trials;
  }
  LegTargets target;
  target.hip.kp = 20.0;
  target.knee.kp = 30.0;
  const ServoLoad load =
      servo_load(geometry, foot_jacobian(geometry, {}, false), {}, target, false, 0.0, {});
  EXPECT_NEAR(load.torque_noise, std::sqrt(squares), 0.02 * load.torque_noise);
}

}  // namespace
}  // namespace touchdown
