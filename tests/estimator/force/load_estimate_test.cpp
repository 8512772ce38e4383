#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "estimator/decision/filter.hpp"
#include "estimator/evidence/filter.hpp"
#include "estimator/force/force_kinematics.hpp"
#include "estimator/force/support_force.hpp"
#include "estimator/free_fall.hpp"
#include "tests/estimator/evidence/random_curves.hpp"
#include "tests/estimator/force/held_leg.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

using test::holding;
using test::mirrored;

constexpr double position_gain = 40.0;  // N·m/rad

/// A robot that holds its legs in one pose.
struct HeldPose {
  double hip = 0.455;
  double knee = -0.791;
  double left = 26.0;   ///< force on the wheel (N)
  double right = 26.0;  ///< likewise
  double acceleration = 0.0;
  double torque_noise = 0.001;  ///< of the sensors (N·m); never zero, so that none is frozen
  bool has_targets = false;
};

/// Targets that make the servos apply these torques.
LegTargets targets_of(const LegSignals& leg) {
  const auto of = [](const JointSignals& joint) {
    return JointTarget{joint.position + joint.torque / position_gain, 0.0, 0.0, position_gain, 1.0};
  };
  return {of(leg.hip), of(leg.knee), of(leg.wheel)};
}

/// The belief after these steps of one millisecond.
Belief held(ContactEstimator& estimator, const HeldPose& pose, int steps = 1000) {
  test::Normal normal(1);
  Signals signals;
  Belief belief;
  for (int k = 0; k < steps; ++k) {
    signals.time += 0.001;
    signals.vertical_acceleration = pose.acceleration + 1e-6 * normal();
    signals.angular_velocity.x() = 1e-6 * normal();
    signals.leg[0] = holding({}, pose.hip, pose.knee, 0.0, pose.left, pose.acceleration);
    signals.leg[1] = mirrored(holding({}, pose.hip, pose.knee, 0.0, pose.right, pose.acceleration));
    for (std::size_t i = 0; i < 2; ++i) {
      LegSignals& leg = signals.leg[i];
      if (pose.has_targets) signals.target[i] = targets_of(leg);
      for (JointSignals* joint : {&leg.hip, &leg.knee, &leg.wheel}) {
        joint->torque += pose.torque_noise * normal();
      }
    }
    belief = estimator.update(signals);
  }
  return belief;
}

std::array<WheelLoad, 2> loads(const HeldPose& pose) {
  SupportForce estimator;
  const Belief belief = held(estimator, pose);
  return {belief.wheel[0].load, belief.wheel[1].load};
}

void expect_within_two_deviations(const WheelLoad& load, double force) {
  EXPECT_LE(std::abs(load.force - force), 2.0 * load.deviation);
  EXPECT_LT(load.deviation, 0.25 * 9.81 * LegGeometry{}.robot_mass);
}

TEST(Load, OfAStandingRobotIsItsWeight) {
  const double weight = 9.81 * LegGeometry{}.robot_mass;
  for (const bool has_targets : {false, true}) {
    const auto [left, right] =
        loads({.left = 0.4 * weight, .right = 0.6 * weight, .has_targets = has_targets});
    expect_within_two_deviations(left, 0.4 * weight);
    expect_within_two_deviations(right, 0.6 * weight);
    EXPECT_NEAR(left.force + right.force, weight, 0.2);
  }
}

TEST(Load, OfAFallingOrLiftedRobotIsZero) {
  for (const double acceleration : {-9.81, 0.5}) {
    for (const WheelLoad& load : loads({.left = 0.0, .right = 0.0, .acceleration = acceleration})) {
      expect_within_two_deviations(load, 0.0);
      EXPECT_NEAR(load.force, 0.0, 0.2);
    }
  }
}

TEST(Load, OfStraightLegsIsKnownFromTargetsAlone) {
  const HeldPose straight = {.hip = 0.03, .knee = -0.06};
  for (const WheelLoad& load : loads(straight)) {
    EXPECT_TRUE(std::isnan(load.force) && std::isnan(load.deviation));
  }
  HeldPose with_targets = straight;
  with_targets.has_targets = true;
  for (const WheelLoad& load : loads(with_targets)) expect_within_two_deviations(load, 26.0);
  with_targets.hip = with_targets.knee = 0.0;  // no targets show the load of a leg in line
  for (const WheelLoad& load : loads(with_targets)) EXPECT_TRUE(std::isnan(load.force));
}

TEST(Load, HasADeviationInProportionToLargeTorqueNoise) {
  const double half = loads({.torque_noise = 1.0})[0].deviation;
  const double whole = loads({.torque_noise = 2.0})[0].deviation;
  EXPECT_NEAR(whole / half, 2.0, 0.3);
  EXPECT_LT(loads({.torque_noise = 2.0, .has_targets = true})[0].deviation, half);
}

TEST(Load, IsUnknownWhileSignalsAreUnusable) {
  SupportForce estimator;
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

TEST(Load, IsTheSameInEveryEstimatorWithLegs) {
  std::vector<std::unique_ptr<ContactEstimator>> estimators;
  estimators.push_back(std::make_unique<ForceKinematics>(
      ForceKinematicsModel{.air = {}, .contact = {.force_mean = 26.0}}));
  estimators.push_back(std::make_unique<EvidenceCurves>(test::random_curve_sets(1)));
  estimators.push_back(std::make_unique<EvidenceCurves>(test::random_curves(1)));
  estimators.push_back(std::make_unique<DecisionNetwork>(DecisionModel()));
  for (const bool has_targets : {false, true}) {
    const HeldPose pose = {.left = 10.0, .torque_noise = 0.3, .has_targets = has_targets};
    const std::array<WheelLoad, 2> expected = loads(pose);
    for (const auto& estimator : estimators) {
      estimator->reset();
      const Belief belief = held(*estimator, pose);
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(belief.wheel[i].load.force, expected[i].force, 1e-9);
        EXPECT_NEAR(belief.wheel[i].load.deviation, expected[i].deviation, 1e-9);
      }
    }
  }
  FreeFall without_legs;
  EXPECT_TRUE(std::isnan(held(without_legs, {}).wheel[0].load.force));
}

}  // namespace
}  // namespace touchdown
