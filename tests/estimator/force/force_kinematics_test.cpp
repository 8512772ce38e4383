#include "estimator/force/force_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/force/force_kinematics_fit.hpp"
#include "tests/estimator/force/carried_run.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

ForceKinematicsModel model() {
  return {
      .air = {.force_mean = 0.0,
              .force_deviation = 4.0,
              .axle_deviation = 0.7,
              .leaving_rate = 5.0},
      .contact = {
          .force_mean = 26.0, .force_deviation = 12.0, .axle_deviation = 0.1, .leaving_rate = 1.0}};
}

double gaussian(double x, double mean, double deviation) {
  const double z = (x - mean) / deviation;
  return std::exp(-0.5 * z * z) / (deviation * std::sqrt(2.0 * std::numbers::pi));
}

double likelihood(const WheelState& state, const WheelObservation& observation) {
  return gaussian(observation.force, state.force_mean, state.force_deviation) *
         gaussian(observation.axle_velocity, 0.0, state.axle_deviation);
}

TEST(ForceKinematics, WeighsObservationsByGaussians) {
  for (const double force : {0.0, 7.0, 26.0}) {
    for (const double velocity : {-0.8, 0.05}) {
      const WheelObservation observation = {force, velocity};
      EXPECT_NEAR(log_likelihood_ratio(model(), observation),
                  std::log(likelihood(model().contact, observation)) -
                      std::log(likelihood(model().air, observation)),
                  1e-9);
    }
  }
}

TEST(ForceKinematics, RatioIncreasesWithTheForce) {
  // By the wider Gaussian alone, a wheel that pulls would count as one on the ground.
  double before = -HUGE_VAL;
  for (double force = -60.0; force <= 150.0; force += 5.0) {
    const double ratio = log_likelihood_ratio(model(), {force, 0.0});
    EXPECT_GE(ratio, before) << force;
    before = ratio;
  }
}

/// A short run with small motions of all joints.
test::CarriedRun busy(int steps) {
  test::CarriedRun run;
  test::Normal normal(9);
  for (int i = 0; i < steps; ++i) {
    Signals& s = run.add(10.0 + 5.0 * normal(), 6.0 + 3.0 * normal(), 2.0 * normal());
    for (LegSignals& leg : s.leg) {
      leg.hip.velocity = 0.5 * normal();
      leg.knee.velocity = 0.5 * normal();
    }
  }
  return run;
}

TEST(ForceKinematics, EqualsTheSumOverAllStateSequences) {
  constexpr int steps = 10;
  const test::CarriedRun run = busy(steps);
  const ForceKinematicsConfig config;
  WheelObservations observations(config);
  ForceKinematics filter(model(), config);
  std::vector<WheelObservation> observed;
  Belief belief;
  for (const Signals& s : run.signals) {
    const bool measured = observations.update(s).is_measured[1];
    belief = filter.update(s);
    if (!measured) continue;
    observed.push_back(observations.of(1));
    // Forces between the means count as they are.
    observed.back().force = std::clamp(observed.back().force, 0.0, 26.0);
  }
  ASSERT_EQ(observed.size(), static_cast<std::size_t>(steps));
  const double takeoff = 1.0 - std::exp(-0.001 * model().contact.leaving_rate);
  const double landing = 1.0 - std::exp(-0.001 * model().air.leaving_rate);
  double contact = 0.0;
  double all = 0.0;
  for (unsigned path = 0; path < (2U << observed.size()); ++path) {  // bit 0: before the first
    double p = 0.5;
    for (std::size_t k = 0; k < observed.size(); ++k) {
      const bool from = (path >> k & 1U) != 0;
      const bool to = (path >> (k + 1) & 1U) != 0;
      const double leave = from ? takeoff : landing;
      p *= (from == to ? 1.0 - leave : leave) *
           likelihood(to ? model().contact : model().air, observed[k]);
    }
    all += p;
    if ((path >> observed.size() & 1U) != 0) contact += p;
  }
  EXPECT_GT(contact / all, 0.001);
  EXPECT_LT(contact / all, 0.999);
  EXPECT_NEAR(belief.wheel[1].p_contact, contact / all, 1e-9);
}

TEST(ForceKinematics, DistinguishesTheWheels) {
  ForceKinematics filter(model());
  test::CarriedRun run;
  for (int i = 0; i < 100; ++i) filter.update(run.add(26.0, 26.0));
  EXPECT_GT(filter.update(run.add(26.0, 26.0)).p_both_wheels, 0.99);
  Belief belief;
  for (int i = 0; i < 100; ++i) belief = filter.update(run.add(52.0, 0.0));
  EXPECT_TRUE(belief.wheel[0].contact);
  EXPECT_FALSE(belief.wheel[1].contact);
  EXPECT_LT(belief.wheel[1].p_contact, 0.01);
}

TEST(AxleMotion, MovesWithTheTorsoOnAStiffLegAndNotOnAYieldingOne) {
  const LegGeometry leg;
  AxleMotion stiff({.leak = 1e6});
  AxleMotion yielding({.leak = 1e6});
  test::CarriedRun run;
  double hip_velocity = 0.0;
  for (int k = 1; k <= 100; ++k) {
    Signals& s = run.add(0.0, 0.0, -5.0);
    stiff.update(s, -5.0);
    // The hip turns so that the axle stays in place.
    const double lever = test::leg_positions(leg, 0.455, -0.791).x;
    hip_velocity = 5.0 * 0.001 * k / lever;
    s.leg[0].hip.velocity = hip_velocity;
    yielding.update(s, -5.0);
  }
  EXPECT_NEAR(stiff.velocity(0), -0.5, 1e-6);
  EXPECT_NEAR(yielding.velocity(0), 0.0, 1e-6);
  EXPECT_GT(hip_velocity, 0.0);
}

TEST(AxleMotion, LeaksTheTorsosVelocity) {
  AxleMotion motion({.leak = 0.2});
  test::CarriedRun run;
  for (int k = 0; k < 2000; ++k) motion.update(run.add(0.0, 0.0), 0.5);
  EXPECT_NEAR(motion.velocity(0), 0.5 * 0.2, 1e-3);  // the error from a biased accelerometer
}

TEST(AxleMotion, IsNotMeasuredWithoutVelocities) {
  AxleMotion motion({});
  test::CarriedRun run;
  motion.update(run.add(0.0, 0.0), 0.0);
  EXPECT_TRUE(motion.is_measured(0));
  run.signals.back().leg[0].knee.velocity = std::nan("");
  motion.update(run.signals.back(), 0.0);
  EXPECT_FALSE(motion.is_measured(0));
  EXPECT_TRUE(motion.is_measured(1));
}

/// A flight of 0.2 s in every second, with forces and motions of known spread.
test::CarriedRun drops(int steps) {
  test::CarriedRun run;
  test::Normal normal(11);
  for (int i = 0; i < steps; ++i) {
    const bool air = i % 1000 >= 800;
    const auto force = [&] { return air ? 1.0 + 2.0 * normal() : 26.0 + 6.0 * normal(); };
    Signals& s = run.add(force(), force());
    for (std::size_t side = 0; side < 2; ++side) {
      s.leg[side].hip.velocity = (air ? 4.0 : 0.5) * normal();
    }
    run.label(!air, !air);
  }
  return run;
}

TEST(ForceKinematics, FindsTheParametersBehindTheRuns) {
  const test::CarriedRun run = drops(20'000);
  const ForceKinematicsModel fitted =
      fit_force_kinematics(std::vector<LabelledRun>{run.view()}, {.low_pass = 0.0});
  const double lever = std::abs(test::leg_positions({}, 0.455, -0.791).x);
  EXPECT_NEAR(fitted.air.force_mean, 1.0, 0.1);
  EXPECT_NEAR(fitted.air.force_deviation, 2.0, 0.1);
  EXPECT_NEAR(fitted.air.axle_deviation, 4.0 * lever, 0.03 * 4.0 * lever);
  EXPECT_NEAR(fitted.air.leaving_rate, 19.0 / 20.0 / 0.2, 1e-9);  // the last flight never ends
  EXPECT_NEAR(fitted.contact.force_mean, 26.0, 0.1);
  EXPECT_NEAR(fitted.contact.force_deviation, 6.0, 0.1);
  EXPECT_NEAR(fitted.contact.leaving_rate, 1.0 / 0.8, 1e-9);
  EXPECT_EQ(fitted.contact.axle_deviation, ForceKinematicsFloors{}.axle_velocity);  // a floor
}

TEST(ForceKinematics, FollowsRunsLikeTheFittedOnes) {
  const test::CarriedRun run = drops(10'000);
  ForceKinematics filter(fit_force_kinematics(std::vector<LabelledRun>{run.view()}));
  int correct = 0;
  for (std::size_t k = 0; k < run.signals.size(); ++k) {
    correct += filter.update(run.signals[k]).wheel[0].contact == (run.contact[0][k] != 0) ? 1 : 0;
  }
  EXPECT_GT(correct, 9'750);
}

TEST(ForceKinematics, NeedsBothStatesAndALabelForEveryStep) {
  test::CarriedRun run;
  for (int i = 0; i < 100; ++i) run.add(26.0, 26.0);
  EXPECT_THROW(static_cast<void>(fit_force_kinematics(std::vector<LabelledRun>{run.view()})),
               InputError);
  run.contact[0].pop_back();
  EXPECT_THROW(static_cast<void>(fit_force_kinematics(std::vector<LabelledRun>{run.view()})),
               InputError);
}

TEST(ForceKinematics, RelaxesForALegWithoutSignals) {
  ForceKinematics filter(model());
  test::CarriedRun run;
  for (int i = 0; i < 100; ++i) filter.update(run.add(26.0, 26.0));
  for (JointSignals LegSignals::*joint : {&LegSignals::hip, &LegSignals::knee}) {
    for (double JointSignals::*value : {&JointSignals::torque, &JointSignals::velocity}) {
      Belief belief;
      for (int i = 0; i < 1000; ++i) {
        Signals& s = run.add(26.0, 26.0);
        s.leg[1].*joint.*value = std::nan("");
        belief = filter.update(s);
      }
      EXPECT_GT(belief.wheel[0].p_contact, 0.99);
      EXPECT_NEAR(belief.wheel[1].p_contact, 0.5, 0.01);
      EXPECT_TRUE(belief.wheel[1].contact);  // the last decision
      for (int i = 0; i < 100; ++i) filter.update(run.add(26.0, 26.0));
    }
  }
}

TEST(ForceKinematics, RefusesInvalidValues) {
  const auto refused = [](const ForceKinematicsConfig& config) {
    EXPECT_THROW((ForceKinematics{model(), config}), InputError);
  };
  refused({.sample_rate = 0.0});
  refused({.geometry = {.upper_length = 0.0}});
  refused({.low_pass = -1.0});
  refused({.largest_force = 0.0});
  refused({.leak = 0.0});
  refused({.threshold = 0.0});
  for (double WheelState::*value :
       {&WheelState::force_deviation, &WheelState::axle_deviation, &WheelState::leaving_rate}) {
    for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
      ForceKinematicsModel broken = model();
      broken.air.*value = bad;
      EXPECT_THROW(ForceKinematics{broken}, InputError);
    }
  }
}

}  // namespace
}  // namespace touchdown
