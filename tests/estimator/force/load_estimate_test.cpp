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
#include "tests/estimator/force/held_pose.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

using test::holding;
using test::mirrored;

using test::expect_within_two_deviations;
using test::held;
using test::held_loads;
using test::HeldPose;

TEST(Load, OfAStandingRobotIsItsWeight) {
  const double weight = 9.81 * LegGeometry{}.robot_mass;
  for (const bool has_targets : {false, true}) {
    const auto [left, right] = held_loads<SupportForce>(
        {.left = 0.4 * weight, .right = 0.6 * weight, .has_targets = has_targets});
    expect_within_two_deviations(left, 0.4 * weight);
    expect_within_two_deviations(right, 0.6 * weight);
    EXPECT_NEAR(left.force + right.force, weight, 0.2);
  }
}

TEST(Load, OfAFallingOrLiftedRobotIsZero) {
  for (const double acceleration : {-9.81, 0.5}) {
    for (const WheelLoad& load :
         held_loads<SupportForce>({.left = 0.0, .right = 0.0, .acceleration = acceleration})) {
      expect_within_two_deviations(load, 0.0);
      EXPECT_NEAR(load.force, 0.0, 0.2);
    }
  }
}

TEST(Load, OfStraightLegsIsKnownFromTargetsAlone) {
  const HeldPose straight = {.hip = 0.03, .knee = -0.06};
  for (const WheelLoad& load : held_loads<SupportForce>(straight)) {
    EXPECT_TRUE(std::isnan(load.force) && std::isnan(load.deviation));
  }
  HeldPose with_targets = straight;
  with_targets.has_targets = true;
  for (const WheelLoad& load : held_loads<SupportForce>(with_targets))
    expect_within_two_deviations(load, 26.0);
  with_targets.hip = with_targets.knee = 0.0;  // no targets show the load of a leg in line
  for (const WheelLoad& load : held_loads<SupportForce>(with_targets))
    EXPECT_TRUE(std::isnan(load.force));
}

TEST(Load, HasADeviationInProportionToLargeTorqueNoise) {
  const double half = held_loads<SupportForce>({.torque_noise = 1.0})[0].deviation;
  const double whole = held_loads<SupportForce>({.torque_noise = 2.0})[0].deviation;
  EXPECT_NEAR(whole / half, 2.0, 0.3);
  EXPECT_LT(held_loads<SupportForce>({.torque_noise = 2.0, .has_targets = true})[0].deviation,
            half);
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
    const std::array<WheelLoad, 2> expected = held_loads<SupportForce>(pose);
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
