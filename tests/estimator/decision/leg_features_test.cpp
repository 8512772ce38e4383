#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "estimator/decision/feature_extractor.hpp"
#include "tests/estimator/force/held_leg.hpp"

namespace touchdown {
namespace {

constexpr double crouched_hip = 0.455;  // rad
constexpr double crouched_knee = -0.791;

LegFeatures features_of(const LegSignals& leg, bool mirrored, double acceleration = 0.0,
                        double torque_noise = 0.0) {
  return LegFeatureExtractor({}, mirrored)
      .update(leg, foot_jacobian({}, leg, mirrored), acceleration, torque_noise);
}

TEST(LegFeatureExtractor, FindsTheLoadOfABentLegInEitherLegsSigns) {
  for (const double force : {0.0, 26.0, 60.0}) {
    for (const double acceleration : {0.0, -9.81, 5.0}) {
      const LegSignals leg =
          test::holding({}, crouched_hip, crouched_knee, 0.0, force, acceleration);
      const double found = features_of(leg, false, acceleration).load;
      EXPECT_NEAR(found, force, 0.021 * std::abs(force - 15.0) + 1e-6);
      EXPECT_EQ(features_of(test::mirrored(leg), true, acceleration).load, found);
    }
  }
}

TEST(LegFeatureExtractor, LoadIsContinuousThroughAStraightLeg) {
  double before = 0.0;
  for (double knee = -0.02; knee <= 0.02; knee += 1e-5) {
    LegSignals leg = test::holding({}, 0.1, knee, 0.0, 26.0, 0.0);
    leg.knee.torque += 0.3;  // which a straight leg could turn into any force
    const double load = features_of(leg, false).load;
    ASSERT_TRUE(std::isfinite(load)) << knee;
    ASSERT_LE(std::abs(load), 200.0) << knee;
    if (knee > -0.0199) {
      ASSERT_NEAR(load, before, 1.0) << knee;
    }
    before = load;
  }
}

TEST(LegFeatureExtractor, LoadOfAStraightLegIsNeutralForAnyTorques) {
  for (const double torque : {0.0, 1.0, -20.0}) {
    for (const double noise : {0.0, 3.0}) {
      LegSignals straight;
      straight.knee.torque = torque;
      EXPECT_EQ(features_of(straight, false, 0.0, noise).load, 15.0) << torque;
    }
  }
}

TEST(LegFeatureExtractor, TrustsALegLessTheStraighterItIsAndTheNoisierItsTorques) {
  for (const double force : {0.0, 26.0}) {
    double of_more_bent = 1.0;
    for (const double knee : {-0.8, -0.3, -0.17, -0.1, -0.05, -0.01}) {
      double before = of_more_bent;
      for (const double noise : {0.0, 0.3, 1.0, 3.0}) {
        const LegSignals leg = test::holding({}, -0.5 * knee, knee, 0.0, force, 0.0);
        const double deviation = features_of(leg, false, 0.0, noise).load - 15.0;
        const double share = deviation / (force - 15.0);
        EXPECT_TRUE(share > 0.0 && share < 1.0) << knee << ", " << noise;
        EXPECT_LT(share, before) << knee << ", " << noise;
        before = share;
        if (noise == 0.0) of_more_bent = share;
      }
    }
    EXPECT_LT(of_more_bent, 0.03);
  }
}

TEST(LegFeatureExtractor, SubtractsTheWheelsInertiaFromItsTorque) {
  for (const double inertia : {LegGeometry{}.wheel_inertia, 9e-4}) {
    DecisionConfig config;
    config.geometry.wheel_inertia = inertia;
    LegFeatureExtractor left(config, false);
    LegFeatureExtractor right(config, true);
    constexpr double acceleration = 300.0;     // rad/s²
    for (const double ground : {-0.2, 0.0}) {  // N·m
      LegFeatures last;
      LegFeatures mirror;
      for (int k = 0; k < 20; ++k) {
        LegSignals leg;
        leg.wheel.velocity = 4.0 + 0.001 * acceleration * k;
        leg.wheel.torque = inertia * acceleration + ground;
        last = left.update(leg, foot_jacobian(config.geometry, leg, false), 0.0, 0.0);
        mirror = right.update(test::mirrored(leg),
                              foot_jacobian(config.geometry, test::mirrored(leg), true), 0.0, 0.0);
      }
      EXPECT_NEAR(last.reaction, ground, 1e-12);
      EXPECT_EQ(mirror.reaction, last.reaction);
    }
  }
}

TEST(LegFeatureExtractor, FindsTheAxlesVelocityRelativeToTheHip) {
  LegSignals leg;
  leg.hip = {crouched_hip, 2.0, 0.0};
  leg.knee = {crouched_knee, -3.0, 0.0};
  constexpr double step = 1e-6;  // s
  const auto height = [](double time) {
    return test::leg_positions({}, crouched_hip + 2.0 * time, crouched_knee - 3.0 * time).z;
  };
  EXPECT_NEAR(features_of(leg, false).axle_velocity, (height(step) - height(-step)) / (2.0 * step),
              1e-6);
  EXPECT_EQ(features_of(test::mirrored(leg), true).axle_velocity,
            features_of(leg, false).axle_velocity);
}

TEST(LegFeatureExtractor, FindsNoAccelerationOfAnAxleAtRestUnderAFallingTorso) {
  // The hip falls at 6 m/s², and the knee bends accordingly.
  const auto leg_at = [](double time) {
    const double height = 0.32 - 0.5 * 6.0 * time * time;
    const double hip = std::acos(0.5 * height / 0.17);
    return std::array<double, 2>{hip, -2.0 * hip};
  };
  DecisionConfig config;
  config.geometry.upper_length = config.geometry.lower_length = 0.17;
  LegFeatureExtractor extractor(config, false);
  LegFeatures last;
  for (int k = 0; k < 100; ++k) {
    constexpr double step = 1e-5;
    const double time = 0.001 * k;
    const auto now = leg_at(time);
    const auto later = leg_at(time + step);
    const auto before = leg_at(time - step);
    LegSignals leg;
    leg.hip = {now[0], (later[0] - before[0]) / (2.0 * step), 0.0};
    leg.knee = {now[1], (later[1] - before[1]) / (2.0 * step), 0.0};
    last = extractor.update(leg, foot_jacobian(config.geometry, leg, false), -6.0, 0.0);
  }
  EXPECT_NEAR(last.axle_velocity, 6.0 * 0.099, 1e-3);
  EXPECT_NEAR(last.axle_acceleration, 0.0, 0.01);
}

}  // namespace
}  // namespace touchdown
