#include "estimator/bayes/filter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/bayes/measurement_only.hpp"
#include "tests/estimator/named_config.hpp"
#include "tests/estimator/synthetic.hpp"

namespace touchdown {
namespace {

using test::drops;
using test::in_the_air;
using test::labelled;

MeasurementModel fitted(const BayesFilterConfig& config) {
  const auto samples = labelled(drops(8000), config.measurement.torque);
  return fit_measurement_model(samples.contact, samples.no_contact, config.measurement.fit);
}

/// σ(x), or with `against` 1 − σ(x) to full relative precision.
double clamped_sigmoid(const Sigmoid& sigmoid, double x, double margin, bool against = false) {
  const double u = (x - sigmoid.offset) / sigmoid.slope;
  const double p = 1.0 / (1.0 + std::exp(against ? u : -u));
  return std::min(1.0 - margin, std::max(margin, p));
}

class NamedBayesFilter : public testing::TestWithParam<const char*> {};

TEST_P(NamedBayesFilter, FollowsTheEquationsStepByStep) {
  const BayesFilterConfig config = test::named(GetParam());
  const MeasurementModel model = fitted(config);
  BayesFilter filter(model, config);
  TransitionModel transition(config.transition, config.sample_rate);
  std::array<TorqueChannel, 2> channels{TorqueChannel(config.measurement.torque, Side::left, 1e3),
                                        TorqueChannel(config.measurement.torque, Side::right, 1e3)};
  std::array<double, 2> bel{0.5, 0.5};
  std::array<double, 2> not_bel{0.5, 0.5};
  for (const Signals& s : drops(3000, 1000.0, 7)) {
    const Transition& t = transition.update(s.vertical_acceleration);
    const Belief& belief = filter.update(s);
    ASSERT_EQ(belief.status, SignalStatus::good);
    for (std::size_t i = 0; i < 2; ++i) {
      const Likelihoods p = model(channels[i].update(s.leg[i]));
      // The published matrix has stay = 1 − P(switch), the repaired one stay = 1 − P(leave).
      const double margin = config.transition.margin;
      const auto sigmoids = [&](bool no_switch, bool takeoff) {
        return std::pair{
            clamped_sigmoid(config.transition.switch_sigmoid, t.power, margin, no_switch),
            clamped_sigmoid(config.transition.landing_sigmoid, t.filtered_median_frequency, margin,
                            takeoff)};
      };
      const auto [p_switch, p_landing] = sigmoids(false, false);
      const auto [p_no_switch, p_takeoff] = sigmoids(true, true);
      const double repair = config.transition.row_stochastic ? p_switch : 0.0;
      const double prior_contact =
          (p_no_switch + repair * p_landing) * bel[i] + p_switch * p_landing * not_bel[i];
      const double prior_air =
          p_switch * p_takeoff * bel[i] + (p_no_switch + repair * p_takeoff) * not_bel[i];
      const double contact = (p.contact + config.measurement.contact_floor) * prior_contact;
      const double air = (p.no_contact + config.measurement.no_contact_floor) * prior_air;
      if (contact + air > 0.0) {
        bel[i] = contact / (contact + air);
        not_bel[i] = air / (contact + air);
      }
      ASSERT_NEAR(belief.wheel[i].p_contact, bel[i], 1e-12) << s.time;
      ASSERT_EQ(belief.wheel[i].contact, belief.wheel[i].p_contact >= 0.8);
    }
    ASSERT_NEAR(belief.p_both_wheels, bel[0] * bel[1], 1e-12);
    ASSERT_NEAR(belief.p_any_wheel, 1.0 - (1.0 - bel[0]) * (1.0 - bel[1]), 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(Configurations, NamedBayesFilter,
                         testing::Values("paper", "paper_rms", "reference", "robust"));

TEST(BayesFilter, DistinguishesFlightsFromRolling) {
  const BayesFilterConfig config = BayesFilterConfig::robust();
  BayesFilter filter(fitted(config), config);
  int correct = 0;
  int counted = 0;
  for (const Signals& s : drops(10'000, 1000.0, 21)) {
    const Belief& belief = filter.update(s);
    if (s.time > 0.3) {
      ++counted;
      correct += belief.wheel[0].contact == !in_the_air(s) ? 1 : 0;
    }
  }
  EXPECT_GT(correct, 0.93 * counted);
}

TEST(BayesFilter, RelaxesToThePriorWithoutAcceleration) {
  const BayesFilterConfig config = BayesFilterConfig::robust();
  BayesFilter filter(fitted(config), config);
  const std::vector<Signals> stream = drops(700);
  for (const Signals& s : stream) {
    filter.update(s);
  }
  const double before = filter.belief().wheel[0].p_contact;
  ASSERT_GT(before, 0.99);
  Signals lost = stream.back();
  lost.vertical_acceleration = std::nan("");
  for (int i = 1; i <= 100; ++i) {
    lost.time = stream.back().time + 0.001 * i;
    EXPECT_EQ(filter.update(lost).status, SignalStatus::invalid);
  }
  EXPECT_NEAR(filter.belief().wheel[0].p_contact, 0.5 + (before - 0.5) * std::exp(-1.0), 1e-9);
}

TEST(BayesFilter, RelaxesOnlyTheLegWithoutTorques) {
  const BayesFilterConfig config = BayesFilterConfig::robust();
  const MeasurementModel model = fitted(config);
  BayesFilter whole(model, config);
  BayesFilter half(model, config);
  for (Signals s : drops(900)) {
    const double expected = whole.update(s).wheel[0].p_contact;
    s.leg[1].wheel.torque = std::nan("");
    const Belief& belief = half.update(s);
    EXPECT_EQ(belief.status, SignalStatus::invalid);
    ASSERT_EQ(belief.wheel[0].p_contact, expected);
    ASSERT_EQ(belief.wheel[1].p_contact, 0.5);
  }
}

TEST(BayesFilter, TreatsAnImpossibleTorqueAsMissing) {
  const BayesFilterConfig config = BayesFilterConfig::robust();
  const MeasurementModel model = fitted(config);
  for (const double huge : {1e308, -1e308, 2e4}) {
    BayesFilter lost(model, config);
    BayesFilter filter(model, config);
    MeasurementOnly measurement_only(model, config);
    for (Signals s : drops(300)) {
      s.leg[1].knee.torque = std::nan("");
      const Belief expected = lost.update(s);
      s.leg[1].knee.torque = huge;
      EXPECT_EQ(filter.update(s).status, SignalStatus::invalid);
      EXPECT_EQ(measurement_only.update(s).status, SignalStatus::invalid);
      for (std::size_t side = 0; side < 2; ++side) {
        ASSERT_EQ(filter.belief().wheel[side].p_contact, expected.wheel[side].p_contact);
      }
    }
  }
}

TEST(BayesFilter, RestartsItsWindowAfterAGap) {
  const BayesFilterConfig config = BayesFilterConfig::robust();
  BayesFilter filter(fitted(config), config);
  std::vector<Signals> stream = drops(900);
  for (const Signals& s : stream) {
    filter.update(s);
  }
  ASSERT_GT(filter.transition().power, 10.0) << "in free flight";
  Signals later = stream[500];
  later.time = stream.back().time + 2.0;
  EXPECT_EQ(filter.update(later).status, SignalStatus::gap);
  EXPECT_LT(filter.transition().power, 1.0) << "the window no longer contains the flight";
  later.time += 0.001;
  EXPECT_EQ(filter.update(later).status, SignalStatus::good);
}

TEST(BayesFilter, ReportsAFrozenAccelerometer) {
  const BayesFilterConfig config = BayesFilterConfig::robust();
  BayesFilter filter(fitted(config), config);
  Signals s = drops(501).back();
  for (int i = 0; i < 400; ++i) {
    s.time += 0.001;
    EXPECT_EQ(filter.update(s).status, SignalStatus::good);
  }
  for (int i = 0; i < 1200; ++i) {
    s.time += 0.001;
    filter.update(s);
  }
  EXPECT_EQ(filter.belief().status, SignalStatus::frozen);
  EXPECT_NEAR(filter.belief().wheel[0].p_contact, 0.5, 1e-3);
  s.time += 0.001;
  s.vertical_acceleration += 0.001;
  EXPECT_EQ(filter.update(s).status, SignalStatus::good);
}

TEST(BayesFilter, WorksAtOtherRates) {
  for (const double rate : {200.0, 400.0}) {
    BayesFilterConfig config = BayesFilterConfig::robust();
    config.sample_rate = rate;
    const auto samples = labelled(drops(4000, rate), config.measurement.torque, rate);
    BayesFilter filter(
        fit_measurement_model(samples.contact, samples.no_contact, config.measurement.fit), config);
    int correct = 0;
    for (const Signals& s : drops(4000, rate, 5)) {
      const Belief& belief = filter.update(s);
      ASSERT_EQ(belief.status, SignalStatus::good);
      correct += belief.wheel[1].contact == !in_the_air(s) ? 1 : 0;
    }
    EXPECT_GT(correct, 3400) << rate;
  }
}

TEST(BayesFilterConfig, HasTheNumbersOfItsSources) {
  const BayesFilterConfig paper = BayesFilterConfig::paper();
  EXPECT_EQ(paper.transition.switch_sigmoid, (Sigmoid{8.0, 1.0}));
  EXPECT_EQ(paper.transition.landing_sigmoid, (Sigmoid{7.5, 2.5}));
  EXPECT_EQ(paper.threshold, 0.8);
  EXPECT_FALSE(paper.transition.row_stochastic);
  const BayesFilterConfig reference = BayesFilterConfig::reference();
  EXPECT_EQ(reference.transition.switch_sigmoid, (Sigmoid{50.0, 5.0}));
  EXPECT_EQ(reference.transition.landing_sigmoid, (Sigmoid{8.0, 3.0}));
  EXPECT_EQ(reference.measurement.contact_floor, 1e-20);
  EXPECT_EQ(reference.measurement.no_contact_floor, 0.0);
  const BayesFilterConfig robust = BayesFilterConfig::robust();
  EXPECT_EQ(robust.measurement.fit.bandwidth_floor, (TorqueBandwidth{0.01, 0.01}));
  EXPECT_TRUE(robust.measurement.noise.is_followed);
  EXPECT_FALSE(reference.measurement.noise.is_followed);
  EXPECT_FALSE(paper.measurement.noise.is_followed);
  EXPECT_EQ(robust.measurement.torque.low_pass, 0.025);
  EXPECT_TRUE(robust.transition.row_stochastic);
}

TEST(BayesFilterConfig, RefusesInvalidValues) {
  const MeasurementModel model = fitted(BayesFilterConfig::robust());
  BayesFilterConfig config;
  config.threshold = 1.5;
  EXPECT_THROW(BayesFilter(model, config), InputError);
  config = {};
  config.sample_rate = 0.0;
  EXPECT_THROW(BayesFilter(model, config), InputError);
  config = {};
  config.measurement.contact_floor = -1.0;
  EXPECT_THROW(BayesFilter(model, config), InputError);
  config = {};
  config.measurement.torque.low_pass = std::nan("");
  EXPECT_THROW(BayesFilter(model, config), InputError);
}

}  // namespace
}  // namespace touchdown
