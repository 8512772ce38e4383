#include "estimator/decision/filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/decision/fit.hpp"
#include "estimator/force/leg_geometry.hpp"
#include "tests/estimator/decision/lifted_run.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

using test::lifted_network;
using test::lifted_run;
using test::quick;

Belief last_of(ContactEstimator& estimator, const test::CarriedRun& run) {
  Belief belief;
  for (const Signals& s : run.signals) belief = estimator.update(s);
  return belief;
}

TEST(DecisionNetwork, LearnsWhichWheelsCarryALoad) {
  DecisionNetwork estimator(lifted_network());
  EXPECT_GT(test::accuracy(estimator, lifted_run(2, 2)), 0.99);
  DecisionNetwork in_noise(lifted_network());
  EXPECT_GT(test::accuracy(in_noise, lifted_run(2, 3, 0.5)), 0.95);
}

TEST(DecisionNetwork, IsFittedToTheSameBits) {
  const test::CarriedRun run = lifted_run(1, 4);
  const std::vector<LabelledRun> runs = {run.view()};
  const DecisionFitConfig config{.passes = 1, .rows = 2000, .batch = 64, .epochs = 1};
  EXPECT_EQ(fit_decision_model(runs, {}, config), fit_decision_model(runs, {}, config));
}

TEST(DecisionNetwork, BelievesTheSameOfARobotTwiceAsHeavy) {
  LegGeometry heavy;
  for (double* of_mass : {&heavy.upper_mass, &heavy.lower_mass, &heavy.wheel_mass,
                          &heavy.wheel_inertia, &heavy.robot_mass}) {
    *of_mass *= 2.0;
  }
  DecisionNetwork of_upkie(lifted_network());
  DecisionNetwork of_heavy(lifted_network(), {.geometry = heavy});
  DecisionNetwork without_mass(lifted_network());
  double largest_difference = 0.0;
  for (Signals s : lifted_run(1, 6, 0.3).signals) {
    const Belief expected = of_upkie.update(s);
    for (LegSignals& leg : s.leg) {
      for (JointSignals* joint : {&leg.hip, &leg.knee, &leg.wheel}) joint->torque *= 2.0;
    }
    const Belief belief = of_heavy.update(s);
    const Belief of_upkies_mass = without_mass.update(s);
    for (std::size_t side = 0; side < 2; ++side) {
      const double p = belief.wheel[side].p_contact;
      ASSERT_EQ(p, expected.wheel[side].p_contact);
      largest_difference =
          std::max(largest_difference, std::abs(p - of_upkies_mass.wheel[side].p_contact));
    }
  }
  EXPECT_GT(largest_difference, 0.1);
}

TEST(DecisionNetwork, IsCalibratedForAnyClassWeights) {
  test::Normal normal(7);
  const test::CarriedRun fitted = test::overlapping_loads(normal);
  const test::CarriedRun others = test::overlapping_loads(normal);
  for (const double exponent : {0.0, -1.0}) {
    DecisionFitConfig config{
        .passes = 1, .rows = 40'000, .share_slow = 0.0, .batch = 256, .epochs = 8};
    config.class_exponent = exponent;
    config.augmentation.largest_torque_noise = config.augmentation.largest_acceleration_noise = 0.0;
    config.augmentation.torque_bias = config.augmentation.gain_error = 0.0;
    DecisionNetwork estimator(
        fit_decision_model(std::vector<LabelledRun>{fitted.view()}, {}, config),
        {.smoothing = 0.0});
    double bias = 0.0;
    double brier = 0.0;
    double best = 0.0;
    for (std::size_t k = 0; k < others.signals.size(); ++k) {
      const double p = estimator.update(others.signals[k]).wheel[0].p_contact;
      const double load = vertical_force({}, others.signals[k].leg[0], false,
                                         others.signals[k].vertical_acceleration);
      // Bayes' rule on two Gaussians: the logit is linear in the load.
      const double truth = 1.0 / (1.0 + std::exp(-(std::log(3.0) + 0.5 * load - 2.0)));
      bias += p - (others.contact[0][k] != 0 ? 1.0 : 0.0);
      brier += std::pow(p - (others.contact[0][k] != 0 ? 1.0 : 0.0), 2);
      best += std::pow(truth - (others.contact[0][k] != 0 ? 1.0 : 0.0), 2);
    }
    const auto steps = static_cast<double>(others.signals.size());
    EXPECT_NEAR(bias / steps, 0.0, 0.03) << exponent;
    EXPECT_LT(brier / steps, best / steps + 0.02) << exponent;
  }
}

TEST(DecisionNetwork, ContinuesWithOneLegWhileTheOtherIsMissing) {
  const std::array<std::function<void(LegSignals&)>, 4> faults = {
      [](LegSignals& leg) { leg.hip.torque = std::nan(""); },
      [](LegSignals& leg) { leg.knee.velocity = HUGE_VAL; },
      [](LegSignals& leg) { leg.wheel.torque = 1e9; },
      [](LegSignals& leg) { leg.wheel.velocity = std::nan(""); }};
  for (const auto& fault : faults) {
    DecisionNetwork estimator(lifted_network());
    test::CarriedRun run;
    for (int k = 0; k < 300; ++k) run.add(26.0, 26.0).vertical_acceleration += 1e-3 * (k % 3);
    last_of(estimator, run);
    Belief belief;
    for (int k = 0; k < 1000; ++k) {
      Signals& s = run.add(26.0, 26.0);
      s.vertical_acceleration += 1e-3 * (k % 3);
      s.leg[0].wheel.position = 1e-3 * k;  // a moving joint is not frozen
      fault(s.leg[1]);
      belief = estimator.update(s);
    }
    EXPECT_EQ(belief.status, SignalStatus::invalid);
    EXPECT_GT(belief.wheel[0].p_contact, 0.95);
    EXPECT_NEAR(belief.wheel[1].p_contact, 0.5, 0.01);
    EXPECT_TRUE(belief.wheel[1].contact);  // the last decision
    belief = estimator.update(run.add(26.0, 26.0));
    EXPECT_EQ(belief.status, SignalStatus::good);
    EXPECT_GT(belief.wheel[1].p_contact, 0.95);
  }
}

TEST(DecisionNetwork, RefusesInvalidValues) {
  const auto refused = [](const DecisionConfig& config) {
    EXPECT_THROW((DecisionNetwork{DecisionModel(), config}), InputError);
  };
  refused({.sample_rate = 0.0});
  refused({.geometry = {.lower_length = 0.0}});
  refused({.geometry = {.wheel_inertia = -1.0}});
  refused({.geometry = {.robot_mass = 0.0}});
  refused({.smoothing = std::numeric_limits<double>::quiet_NaN()});
  refused({.point = {.leave_below = 0.9, .return_above = 0.5}});
  refused({.point = {.leave_below = 0.0}});
  refused({.point = {.settle_at = 1.0}});
  refused({.point = {.settle_after = -0.02}});
  DecisionModel broken;
  broken.last_bias = std::numeric_limits<float>::infinity();
  EXPECT_THROW(DecisionNetwork{broken}, InputError);

  const test::CarriedRun run = lifted_run(1, 10);
  const std::vector<LabelledRun> runs = {run.view()};
  const auto refused_fit = [&](const DecisionFitConfig& config) {
    EXPECT_THROW(static_cast<void>(fit_decision_model(runs, {}, config)), InputError);
  };
  refused_fit({.passes = 0});
  refused_fit({.learning_rate = -1.0});
  refused_fit({.augmentation = {.share_with_bias = 2.0}});
  EXPECT_THROW(static_cast<void>(fit_decision_model({}, {}, quick)), InputError);
  test::CarriedRun standing = run;
  for (auto& wheel : standing.contact) wheel.assign(wheel.size(), 1);
  EXPECT_THROW(
      static_cast<void>(fit_decision_model(std::vector<LabelledRun>{standing.view()}, {}, quick)),
      InputError);
  standing.contact[0].pop_back();
  EXPECT_THROW(
      static_cast<void>(fit_decision_model(std::vector<LabelledRun>{standing.view()}, {}, quick)),
      InputError);
}

}  // namespace
}  // namespace touchdown
