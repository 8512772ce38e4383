#include "estimator/force/dynamic_loads.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "estimator/force/load_filter.hpp"
#include "tests/estimator/force/held_leg.hpp"
#include "tests/estimator/force/held_pose.hpp"
#include "tests/estimator/force/moving_leg.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

using test::gravity;
using test::holding;
using test::mirrored;
using test::MovingLeg;
using test::PlanarMotion;
using test::PlanarPose;
using test::targets_of;

using test::expect_within_two_deviations;
using test::held;
using test::held_loads;
using test::HeldPose;

TEST(DynamicLoad, OfAStandingRobotIsItsWeight) {
  const double weight = 9.81 * LegGeometry{}.robot_mass;
  for (const bool has_targets : {false, true}) {
    const auto [left, right] = held_loads<LoadFilter>(
        {.left = 0.4 * weight, .right = 0.6 * weight, .has_targets = has_targets});
    expect_within_two_deviations(left, 0.4 * weight);
    expect_within_two_deviations(right, 0.6 * weight);
    EXPECT_NEAR(left.force + right.force, weight, 0.2);
  }
}

TEST(DynamicLoad, OfAFallingOrLiftedRobotIsZero) {
  for (const double acceleration : {-9.81, 0.5}) {
    for (const WheelLoad& load :
         held_loads<LoadFilter>({.left = 0.0, .right = 0.0, .acceleration = acceleration})) {
      expect_within_two_deviations(load, 0.0);
      EXPECT_NEAR(load.force, 0.0, 0.2);
    }
  }
}

TEST(DynamicLoad, OfStraightLegsIsKnownFromTargetsOrTheSumOfBoth) {
  for (const bool has_targets : {false, true}) {
    for (const double bent : {0.03, 0.1}) {
      for (const WheelLoad& load :
           held_loads<LoadFilter>({.hip = bent, .knee = -2.0 * bent, .has_targets = has_targets})) {
        expect_within_two_deviations(load, 26.0);
      }
    }
  }
}

TEST(DynamicLoad, OfLegsInLineIsKnownWithoutAGroundAlone) {
  for (const bool has_targets : {false, true}) {
    HeldPose in_line = {.hip = 0.0, .knee = 0.0, .has_targets = has_targets};
    for (const WheelLoad& load : held_loads<LoadFilter>(in_line)) {
      EXPECT_TRUE(std::isnan(load.force) && std::isnan(load.deviation));
    }
    in_line.acceleration = -9.81;
    in_line.left = in_line.right = 0.0;
    for (const WheelLoad& load : held_loads<LoadFilter>(in_line)) {
      expect_within_two_deviations(load, 0.0);
      EXPECT_LT(load.deviation, 6.0);
    }
  }
}

TEST(DynamicLoad, IsThatOfTheTorquesWhileTheAccelerometerRings) {
  for (const double frequency : {20.0, 30.0, 60.0}) {
    for (const double amplitude : {5.0, 20.0}) {
      LoadFilter estimator;
      Signals signals;
      signals.leg[0] = holding({}, 0.455, -0.791, 0.0, 10.0, 0.0);
      signals.leg[1] = mirrored(holding({}, 0.455, -0.791, 0.0, 42.4, 0.0));
      int known = 0;
      double squares = 0.0;
      for (int k = 0; k < 1000; ++k) {
        signals.time = 0.001 * k;
        signals.vertical_acceleration = amplitude * std::sin(6.283 * frequency * signals.time);
        const WheelLoad load = estimator.update(signals).wheel[0].load;
        if (k < 200 || std::isnan(load.force)) continue;
        expect_within_two_deviations(load, 10.0);
        ++known;
        squares += std::pow(load.force - 10.0, 2);
      }
      EXPECT_GT(known, 700);
      EXPECT_LT(std::sqrt(squares / known), 1.0 + 0.1 * amplitude)
          << frequency << " Hz, " << amplitude << " m/s²";
    }
  }
}

TEST(DynamicLoad, HasADeviationInProportionToLargeTorqueNoise) {
  const double half = held_loads<LoadFilter>({.torque_noise = 0.7})[0].deviation;
  const double whole = held_loads<LoadFilter>({.torque_noise = 1.4})[0].deviation;
  EXPECT_NEAR(whole / half, 2.0, 0.3);
  EXPECT_LT(held_loads<LoadFilter>({.torque_noise = 1.4, .has_targets = true})[0].deviation, half);
}

TEST(DynamicLoad, HasTheDeviationOfItsErrorsWhicheverJointsAreNoisy) {
  constexpr double quiet = 0.002;
  for (const std::array<double, 3>& noisy :
       {std::array{1.0, quiet, quiet}, std::array{quiet, 1.0, quiet}, std::array{quiet, quiet, 1.0},
        std::array{quiet, 1.0, 1.0}, std::array{1.0, 0.5, 0.25}}) {
    double squares = 0.0;
    double variance = 0.0;
    for (int steps = 600; steps < 900; steps += 10) {
      LoadFilter estimator;
      const Belief belief = held(estimator, {.torque_noise = 0.6, .noisy = noisy}, steps);
      for (const WheelBelief& wheel : belief.wheel) {
        squares += std::pow(wheel.load.force - 26.0, 2);
        variance += std::pow(wheel.load.deviation, 2);
      }
    }
    EXPECT_NEAR(std::sqrt(squares / variance), 1.0, 0.35)
        << noisy[0] << " " << noisy[1] << " " << noisy[2];
  }
  // The servos' laws know the load whatever the noise of torque sensors.
  EXPECT_LT(held_loads<LoadFilter>(
                {.torque_noise = 4.0, .noisy = {quiet, 1.0, 1.0}, .has_targets = true})[0]
                .deviation,
            3.0);
}

TEST(DynamicLoad, IsUnknownWhileSignalsAreUnusable) {
  LoadFilter estimator;
  held(estimator, {});
  Signals signals;
  signals.time = 1.001;
  signals.leg[0] = holding({}, 0.455, -0.791, 0.0, 26.0, 0.0);
  signals.leg[1] = mirrored(signals.leg[0]);
  signals.leg[1].hip.torque = std::nan("");
  const Belief& belief = estimator.update(signals);
  EXPECT_NEAR(belief.wheel[0].load.force, 26.0, 0.2);
  EXPECT_TRUE(std::isnan(belief.wheel[1].load.force));
  signals.time += 0.001;
  signals.vertical_acceleration = std::nan("");
  EXPECT_TRUE(std::isnan(estimator.update(signals).wheel[0].load.force));
}

/// A heavier robot than Upkie, with everything that Upkie's file does not have.
LegGeometry with_rotors() {
  LegGeometry geometry;
  geometry.upper_inertia = 0.006;
  geometry.wheel_inertia = 1.2e-3;
  geometry.hip_armature = 0.01;
  geometry.knee_armature = 0.006;
  geometry.wheel_armature = 1e-3;
  geometry.hip_viscous = 0.2;
  geometry.knee_viscous = 0.1;
  geometry.wheel_viscous = 0.01;
  geometry.hip_forward = 0.05;
  geometry.hip_upward = -0.12;
  geometry.robot_mass = 12.0;
  return geometry;
}

/// A torso that rocks and heaves over legs that swing.
PlanarPose swinging(double time) {
  return {.x = 0.3 * time + 0.02 * std::sin(7.0 * time),
          .z = 0.04 * std::sin(9.0 * time),
          .pitch = 0.2 + 0.15 * std::sin(6.0 * time),
          .hip = 0.5 + 0.3 * std::sin(11.0 * time),
          .knee = -1.0 + 0.4 * std::sin(13.0 * time + 1.0),
          .wheel = 20.0 * time + 2.0 * std::sin(8.0 * time)};
}

struct LoadErrors {
  double largest = 0.0;     ///< N
  double deviations = 0.0;  ///< of their errors, at most
  double apart = 0.0;       ///< the right wheel from the left (N)
};

/// The largest errors of loads over a second of a motion, with this force on the wheels (N).
LoadErrors errors(const LegGeometry& geometry, const PlanarMotion& motion, double forward,
                  double upward, const LegGeometry& assumed) {
  DynamicLoads estimates(assumed, 1000.0);
  const MovingLeg leg(geometry, motion);
  LoadErrors errors;
  for (int k = 0; k < 1000; ++k) {
    const DynamicLoads::Loads loads =
        estimates.update(leg.at(0.001 * k, forward, upward, 0.05 * forward), true);
    if (k < 50) continue;
    const double error = std::abs(loads[0].force - upward);
    errors.largest = std::max(errors.largest, error);
    errors.deviations = std::max(errors.deviations, error / loads[0].deviation);
    errors.apart = std::max(errors.apart, std::abs(loads[1].force - loads[0].force));
  }
  return errors;
}

LoadErrors errors(const LegGeometry& geometry, double forward, double upward) {
  return errors(geometry, swinging, forward, upward, geometry);
}

TEST(DynamicLoad, OfLegsThatSwingInTheAirIsZero) {
  for (const LegGeometry& geometry : {LegGeometry{}, with_rotors()}) {
    const LoadErrors found = errors(geometry, 0.0, 0.0);
    EXPECT_LT(found.deviations, 2.0);
    EXPECT_LT(found.largest, 0.03 * gravity * geometry.robot_mass);
    EXPECT_LT(found.apart, 1e-9);
  }
}

TEST(DynamicLoad, OfLegsThatSwingOnTheGroundIsTheVerticalForce) {
  for (const LegGeometry& geometry : {LegGeometry{}, with_rotors()}) {
    const double weight = gravity * geometry.robot_mass;
    const LoadErrors found = errors(geometry, 0.2 * weight, 0.6 * weight);
    EXPECT_LT(found.deviations, 2.0);
    EXPECT_LT(found.largest, 0.05 * weight);
  }
}

TEST(DynamicLoad, NeedsTheInertiaOfLinksAndRotorsAndTheirFriction) {
  const LegGeometry geometry = with_rotors();
  const double usual = errors(geometry, 0.0, 0.0).largest;
  LegGeometry without_rotors = geometry;
  without_rotors.hip_armature = without_rotors.knee_armature = 0.0;
  EXPECT_GT(errors(geometry, swinging, 0.0, 0.0, without_rotors).largest, 3.0 * usual);
  LegGeometry without_friction = geometry;
  without_friction.hip_viscous = without_friction.knee_viscous = 0.0;
  EXPECT_GT(errors(geometry, swinging, 0.0, 0.0, without_friction).largest, 3.0 * usual);
  LegGeometry light = geometry;
  light.upper_mass = light.lower_mass = 0.01;
  EXPECT_GT(errors(geometry, swinging, 0.0, 0.0, light).largest, 3.0 * usual);
  LegGeometry other_imu = geometry;
  other_imu.hip_upward = 1.0;
  EXPECT_GT(errors(geometry, swinging, 0.0, 0.0, other_imu).largest, 3.0 * usual);
}

TEST(DynamicLoad, OfATiltedTorsoIsAlongTheVertical) {
  const auto tilted = [](double /*time*/) {
    return PlanarPose{.pitch = 0.6, .hip = 1.0, .knee = -0.9};
  };
  const double half = 0.5 * gravity * LegGeometry{}.robot_mass;
  EXPECT_LT(errors({}, tilted, 0.0, half, {}).largest, 0.02);
  EXPECT_LT(errors({}, tilted, 5.0, half, {}).largest, 0.02);
}

/// A leg without a hip: its base turns as if it were the upper link.
TEST(DynamicLoad, OfALegWithoutAHipUsesTheForwardAcceleration) {
  LegGeometry geometry;
  geometry.upper_length = 100.0 * geometry.lower_length;
  geometry.upper_mass = geometry.upper_centre = geometry.upper_inertia = 0.0;
  LegGeometry body = geometry;  // the oracle's hip and knee are in one place
  body.upper_length = 0.0;
  const auto braking = [](double time) {
    return PlanarPose{.x = -1.5 * time * time, .pitch = 0.1, .hip = 0.0, .knee = -0.5};
  };
  const double forward = -0.5 * 3.0 * geometry.robot_mass;  // of each wheel
  const double weight = gravity * geometry.robot_mass;
  for (const double share : {0.5, 0.2}) {
    DynamicLoads estimates(geometry, 1000.0);
    DynamicLoads::Loads loads;
    for (int k = 0; k < 100; ++k) {
      const MovingLeg leg(body, braking);
      Signals signals = leg.at(0.001 * k, forward, share * weight);
      signals.leg[1] = leg.at(0.001 * k, forward, (1.0 - share) * weight).leg[1];
      for (LegSignals& of : signals.leg) of.hip = {std::nan(""), std::nan(""), std::nan("")};
      loads = estimates.update(signals, true);
    }
    expect_within_two_deviations(loads[0], share * weight);
    expect_within_two_deviations(loads[1], (1.0 - share) * weight);
    EXPECT_NEAR(loads[0].force, share * weight, 0.02 * weight);
  }
}

/// Of a standing robot whose knees' targets are far away.
TEST(DynamicLoad, ByServosEndsAtTheLimitsOfTheirTorques) {
  const auto load_with = [](double limit, double asked) {
    LegGeometry geometry;
    geometry.knee_torque_limit = limit;
    DynamicLoads estimates(geometry, 1000.0);
    test::Normal normal(1);
    DynamicLoads::Loads loads;
    for (int k = 0; k < 500; ++k) {
      Signals signals;
      signals.time = 0.001 * k;
      for (std::size_t side = 0; side < 2; ++side) {
        LegSignals& leg = signals.leg[side];
        leg = holding(geometry, 0.455, -0.791, 0.0, 26.0, 0.0);
        if (side == 1) leg = mirrored(leg);
        signals.target[side] = targets_of(leg);
        signals.target[side].knee.feedforward_torque = asked * leg.knee.torque;
        signals.target[side].knee.position = leg.knee.position;
        leg.knee.torque += 3.0 * normal();  // so that the servos' laws count
        leg.hip.torque += 3.0 * normal();
      }
      loads = estimates.update(signals, true);
    }
    return loads[0];
  };
  const double needed = std::abs(holding({}, 0.455, -0.791, 0.0, 26.0, 0.0).knee.torque);
  EXPECT_NEAR(load_with(no_torque_limit, 1.0).force, 26.0, 1.0);
  EXPECT_GT(load_with(no_torque_limit, 3.0).force, 60.0);
  EXPECT_NEAR(load_with(needed, 3.0).force, 26.0, 1.0);
}

TEST(DynamicLoad, NeedsTheVerticalAccelerationAlone) {
  // As programs give it that do not know the attitude: the torso is level.
  DynamicLoads estimates({}, 1000.0);
  Signals falling;
  const double load = 0.5 * LegGeometry{}.robot_mass * (gravity - 6.0);
  falling.leg[0] = holding({}, 0.455, -0.791, 0.0, load, -6.0);
  falling.leg[1] = mirrored(falling.leg[0]);
  falling.vertical_acceleration = -6.0;
  DynamicLoads::Loads loads;
  for (int k = 0; k < 100; ++k) {
    falling.time = 0.001 * k;
    loads = estimates.update(falling, true);
  }
  EXPECT_NEAR(loads[1].force, load, 0.01);
}

TEST(DynamicLoad, StartsAnewAfterAGapOfASensor) {
  const MovingLeg leg({}, swinging);
  DynamicLoads interrupted({}, 1000.0);
  DynamicLoads fresh({}, 1000.0);
  for (int k = 0; k < 800; ++k) {
    Signals signals = leg.at(0.001 * k, 0.0, 20.0);
    const bool is_silent = k >= 100 && k < 150;
    if (is_silent) signals.leg[0].knee.velocity = std::nan("");
    const DynamicLoads::Loads loads = interrupted.update(signals, true);
    EXPECT_EQ(std::isnan(loads[0].force), is_silent);
    EXPECT_FALSE(std::isnan(loads[1].force));
    if (k < 150) continue;
    const double restarted = fresh.update(signals, true)[0].force;
    if (k > 600) {
      EXPECT_NEAR(loads[0].force, restarted, 1e-6);
    }
  }
}

}  // namespace
}  // namespace touchdown
