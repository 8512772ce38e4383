#include "estimator/decision/feature_extractor.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "tests/estimator/force/carried_run.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

TEST(LowPassBank, FollowsAStepWithTimeConstantsOfOneTo128Milliseconds) {
  for (const double rate : {1000.0, 200.0}) {
    LowPassBank scales(rate);
    scales.update(2.0);
    for (const float value : scales.values()) EXPECT_EQ(value, 2.0F);
    for (int k = 1; k <= 100; ++k) {
      scales.update(5.0);
      for (std::size_t i = 0; i < decision_scales; ++i) {
        const double time_constant = 0.001 * std::pow(2.0, static_cast<double>(i));
        const double expected = 5.0 - 3.0 * std::exp(-k / rate / time_constant);
        ASSERT_NEAR(scales.values()[i], expected, 1e-5) << i;
      }
    }
  }
}

TEST(LowPassBank, FastForwardsThroughADropout) {
  LowPassBank complete(1000.0);
  LowPassBank dropout(1000.0);
  for (LowPassBank* scales : {&complete, &dropout}) scales->update(2.0);
  for (int k = 0; k < 100; ++k) complete.update(5.0);
  dropout.fast_forward(5.0, 0.099);
  dropout.update(5.0);
  for (std::size_t i = 0; i < decision_scales; ++i) {
    EXPECT_NEAR(dropout.values()[i], complete.values()[i], 1e-5) << i;
  }
  dropout.fast_forward(-7.0, std::numeric_limits<double>::infinity());
  for (const float value : dropout.values()) EXPECT_NEAR(value, -7.0F, 1e-5);
}

/// A robot with random loads, torques, motions and accelerations.
std::vector<Signals> wandering(std::size_t steps) {
  test::Normal normal(5);
  test::CarriedRun run;
  for (std::size_t k = 0; k < steps; ++k) {
    Signals& s = run.add(20.0 + 8.0 * normal(), 20.0 + 8.0 * normal(), 2.0 * normal());
    s.angular_velocity.x() = 0.3 * normal();
    for (LegSignals& leg : s.leg) {
      leg.hip.velocity = normal();
      leg.knee.velocity = normal();
      leg.wheel = {0.0, 10.0 * normal(), 0.2 * normal()};
    }
  }
  return run.signals;
}

TEST(FeatureExtractor, SwapsTheWheelsOfAMirroredRobot) {
  FeatureExtractor robot({});
  FeatureExtractor mirror({});
  for (const Signals& s : wandering(500)) {
    robot.update(s);
    robot.compute_inputs();
    mirror.update(test::in_the_mirror(s));
    mirror.compute_inputs();
    for (std::size_t side = 0; side < 2; ++side) {
      for (std::size_t i = 0; i < decision_inputs; ++i) {
        ASSERT_NEAR(mirror.inputs(side)[i], robot.inputs(1 - side)[i], 1e-5) << i;
      }
    }
  }
  EXPECT_NE(robot.inputs(0), robot.inputs(1));
}

/// The compression of every channel: y → y / (1 + |y| / 4).
double compressed(double y) { return y / (1.0 + 0.25 * std::abs(y)); }

TEST(FeatureExtractor, CompressesEveryChannelBySoftsign) {
  FeatureExtractor features({});
  Signals s;
  s.vertical_acceleration = -9.0;
  s.angular_velocity.x() = 0.6;
  features.update(s);
  features.compute_inputs();
  constexpr std::size_t acceleration = 2 * decision_leg_channels * decision_scales;
  for (std::size_t i = acceleration; i < acceleration + decision_scales; ++i) {
    EXPECT_NEAR(features.inputs(0)[i], compressed(-9.0 / 3.0), 1e-6);
    EXPECT_NEAR(features.inputs(0)[i + decision_scales], compressed(0.6 / 0.3), 1e-6);
    EXPECT_NEAR(features.inputs(1)[i + decision_scales], -compressed(0.6 / 0.3), 1e-6);
  }
}

TEST(FeatureExtractor, EstimatesTheNoiseOfItsSignals) {
  FeatureExtractor features({});
  test::Normal normal(6);
  test::CarriedRun run;
  for (int k = 0; k < 4000; ++k) {
    Signals& s = run.add(26.0, 26.0);
    for (LegSignals& leg : s.leg) leg.knee.torque += 0.8 * normal();
    s.vertical_acceleration += 4.0 * normal();
    features.update(s);
  }
  features.compute_inputs();
  EXPECT_NEAR(features.torque_noise(), 0.8, 0.12);
  EXPECT_NEAR(features.inputs(1)[decision_inputs - 2], std::log(0.8), 0.15);
  EXPECT_NEAR(features.inputs(1)[decision_inputs - 1], std::log(4.0), 0.25);
}

TEST(FeatureExtractor, ScalesNoiseToWhatALowPassLeavesAtAnyRate) {
  // Behind the low-pass of 64 ms, white noise at 200 Hz is as large as √5 times that noise at 1
  // kHz.
  std::array<double, 2> estimated{};
  std::array<double, 2> remaining{};
  for (const std::size_t slow : {0U, 1U}) {
    const double rate = slow == 0 ? 1000.0 : 200.0;
    FeatureExtractor features({.sample_rate = rate});
    test::Normal normal(7);
    const double sigma = slow == 0 ? 0.8 * std::sqrt(5.0) : 0.8;
    double squares = 0.0;
    LowPassBank scales(rate);
    for (int k = 0; k < 20'000; ++k) {
      test::CarriedRun run;
      Signals& s = run.add(26.0, 26.0);
      s.time = k / rate;
      for (LegSignals& leg : s.leg) leg.knee.torque += sigma * normal();
      features.update(s);
      scales.update(sigma * normal());
      if (k >= 1000) squares += scales.values()[6] * scales.values()[6];
    }
    estimated[slow] = features.torque_noise();
    remaining[slow] = std::sqrt(squares);
  }
  EXPECT_NEAR(estimated[1] / estimated[0], 1.0, 0.15);
  EXPECT_NEAR(std::log(remaining[1] / remaining[0]), 0.0, 0.15);
}

TEST(FeatureExtractor, GivesPairInputsAsSumsAndDifferencesOfTheWheelsInputs) {
  constexpr std::size_t of_legs = DecisionPairInputs::of_legs;
  FeatureExtractor features({});
  for (const Signals& s : wandering(200)) features.update(s);
  features.compute_inputs();
  const DecisionInputs of_left = features.inputs(0);
  const DecisionInputs of_right = features.inputs(1);
  features.compute_pair_inputs();
  const DecisionPairInputs pair = features.pair_inputs();
  for (std::size_t i = 0; i < of_legs; ++i) {
    EXPECT_EQ(pair.common[i], of_left[i] + of_right[i]);
    EXPECT_EQ(pair.difference[i], of_left[i] - of_right[i]);
  }
  for (std::size_t i = 0; i < decision_scales; ++i) {
    EXPECT_EQ(pair.common[of_legs + i], of_left[2 * of_legs + i]);
    EXPECT_EQ(pair.difference[of_legs + i], of_left[2 * of_legs + decision_scales + i]);
  }
  EXPECT_EQ(pair.common[of_legs + decision_scales], of_left[decision_inputs - 2]);
  EXPECT_EQ(pair.common[of_legs + decision_scales + 1], of_left[decision_inputs - 1]);
}

TEST(FeatureExtractor, CopiesTheOtherLegsFeaturesForAMissingLeg) {
  FeatureExtractor features({});
  test::CarriedRun run;
  features.update(run.add(26.0, 0.0));
  features.compute_inputs();
  EXPECT_NE(features.inputs(0)[0], features.inputs(1)[0]);
  run.add(26.0, 0.0).leg[1].hip.torque = std::nan("");
  const FeatureExtractor::Step step = features.update(run.signals.back());
  features.compute_inputs();
  EXPECT_EQ(step.status, SignalStatus::invalid);
  EXPECT_TRUE(step.is_valid[0]);
  EXPECT_FALSE(step.is_valid[1]);
  constexpr std::size_t leg = decision_leg_channels * decision_scales;
  for (std::size_t i = 0; i < leg; ++i) {
    EXPECT_EQ(features.inputs(0)[leg + i], features.inputs(0)[i]);
  }
}

/// The signals of a crouched robot that stands, with targets of `gain` that explain its torques.
Signals standing_with_targets(double time, double gain) {
  Signals signals;
  signals.time = time;
  for (std::size_t side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    LegSignals& leg = signals.leg[side];
    LegTargets& target = signals.target[side];
    // Sensors never repeat themselves.
    leg.hip = {sign * 0.5, 1e-6 * std::sin(900.0 * time), sign * 0.4};
    leg.knee = {sign * -1.0, 1e-6 * std::sin(800.0 * time), sign * -1.9};
    leg.wheel = {time, 1e-6 * std::cos(700.0 * time), 0.0};
    for (auto [joint, to] : {std::pair(&leg.hip, &target.hip), {&leg.knee, &target.knee}}) {
      *to = {joint->position + joint->torque / gain, joint->velocity, 0.0, gain, 1.0};
    }
  }
  signals.vertical_acceleration = 1e-6 * std::sin(600.0 * time);
  signals.angular_velocity = {1e-6 * std::sin(500.0 * time), 0.0, 0.0};
  return signals;
}

TEST(FeatureExtractor, ServoLoadIsTheLoadWithoutItsTorques) {
  const double area = 0.168 * 0.175 * std::sin(1.0);  // of the standing legs
  const auto weight = [area](double least) { return 1.0 / (1.0 + std::pow(least / area, 2)); };
  for (const double rate : {1000.0, 200.0}) {
    FeatureExtractor features({.sample_rate = rate, .servo_load = true});
    FeatureExtractor without({.sample_rate = rate});
    for (int k = 0; k < 50; ++k) {
      const Signals signals = standing_with_targets(k / rate, 40.0);
      ASSERT_EQ(features.update(signals).status, SignalStatus::good);
      without.update(signals);
    }
    features.compute_inputs();
    without.compute_inputs();
    EXPECT_EQ(features.left_inputs(), without.left_inputs());
    EXPECT_EQ(without.left_servo_load(), ServoLoadInputs{});
    for (const std::size_t side : {0U, 1U}) {
      for (std::size_t i = 0; i < decision_scales; ++i) {
        // Of the same force, with less of the neutral load.
        const auto y = static_cast<double>(features.inputs(side)[i]);
        const double load = 5.0 * y / (1.0 - 0.25 * std::abs(y));
        const double force = (load - (1.0 - weight(0.003)) * 15.0) / weight(0.003);
        const double expected = weight(0.001) * force + (1.0 - weight(0.001)) * 15.0;
        EXPECT_NEAR(features.servo_load(side)[i], compressed(expected / 5.0), 1e-3) << i;
      }
    }
    features.compute_pair_inputs();
    const auto pair = features.pair_inputs();
    for (std::size_t i = 0; i < decision_scales; ++i) {
      const float left = features.left_servo_load()[i];
      const float right = features.left_servo_load()[decision_scales + i];
      EXPECT_EQ(pair.servo_common[i], left + right);
      EXPECT_EQ(pair.servo_difference[i], left - right);
    }
  }
}

TEST(FeatureExtractor, MutesTheServoLoadAndReportsIt) {
  const auto is_neutral = [](const FeatureExtractor& features, std::size_t side) {
    // 15 N, compressed by the softsign of loads of 5 N.
    const ServoLoadInputs inputs = features.servo_load(side);
    return std::abs(inputs[0] - 3.0F / (1.0F + 3.0F / saturation)) < 1e-5F;
  };
  const auto without_left_knee = [](double JointTarget::*member, double value) {
    Signals signals = standing_with_targets(0.0, 40.0);
    signals.target[0].knee.*member = value;
    return signals;
  };
  for (const Signals& signals :
       {without_left_knee(&JointTarget::position, std::nan("")),
        without_left_knee(&JointTarget::kp, 0.0), without_left_knee(&JointTarget::kd, std::nan("")),
        without_left_knee(&JointTarget::feedforward_torque, HUGE_VAL)}) {
    FeatureExtractor features({.servo_load = true});
    const FeatureExtractor::Step step = features.update(signals);
    EXPECT_EQ(step.status, SignalStatus::degraded);
    EXPECT_TRUE(step.is_valid[0] && step.is_valid[1]);
    features.compute_inputs();
    EXPECT_TRUE(is_neutral(features, 0));
    EXPECT_FALSE(is_neutral(features, 1));  // the other leg has its targets
    // A model without this channel does not miss them.
    EXPECT_EQ(FeatureExtractor(DecisionConfig{}).update(signals).status, SignalStatus::good);
  }
  // Other faults come first, and a wheel's target is not needed.
  FeatureExtractor features({.servo_load = true});
  Signals signals = standing_with_targets(0.0, 40.0);
  signals.target = {};
  signals.angular_velocity.x() = std::nan("");
  EXPECT_EQ(features.update(signals).status, SignalStatus::invalid);
  signals = standing_with_targets(0.001, 40.0);
  signals.target[0].wheel = signals.target[1].wheel = {};
  EXPECT_EQ(features.update(signals).status, SignalStatus::good);
}

}  // namespace
}  // namespace touchdown
