#include "estimator/force/load_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/estimator/force/held_leg.hpp"
#include "tests/estimator/force/held_pose.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

using test::gravity;
using test::holding;
using test::mirrored;

const double weight = gravity * LegGeometry{}.robot_mass;

/// A crouching robot with these loads on its wheels (N) at a time (s).
Signals carrying(double time, double left, double right) {
  Signals signals;
  signals.time = time;
  signals.vertical_acceleration = 1e-9 * std::sin(1e4 * time);  // never frozen
  signals.leg[0] = holding({}, 0.455, -0.791, 0.0, left, 0.0);
  signals.leg[1] = mirrored(holding({}, 0.455, -0.791, 0.0, right, 0.0));
  return signals;
}

/// A load that falls to zero within 20 ms and comes back at once; the other wheel takes over.
double load_at(double time) {
  if (time < 0.5 || time > 0.8) return 26.0;
  return std::max(0.0, 26.0 * (1.0 - (time - 0.5) / 0.02));
}

/// When a wheel is first out of contact after half a second, and in contact again (s).
struct Events {
  double takeoff = -1.0;
  double landing = -1.0;
};

Events events(const LoadFilterConfig& config) {
  LoadFilter filter(config);
  Events found;
  for (int k = 0; k < static_cast<int>(config.sample_rate); ++k) {
    const double time = k / config.sample_rate;
    const Belief& belief = filter.update(carrying(time, load_at(time), 26.0));
    const bool contact = belief.wheel[0].contact;
    if (time > 0.3 && !contact && found.takeoff < 0.0) found.takeoff = time;
    if (found.takeoff > 0.0 && contact && found.landing < 0.0) found.landing = time;
    EXPECT_TRUE(time < 0.3 || belief.wheel[1].contact);
  }
  return found;
}

TEST(LoadFilter, FindsATakeoffAndALandingOfOneWheel) {
  const Events found = events({});
  EXPECT_NEAR(found.takeoff, 0.52, 0.01);
  EXPECT_NEAR(found.landing, 0.80, 0.015);
}

TEST(LoadFilter, AnnouncesATakeoffByItsLeadButNotALanding) {
  const Events with = events({.lead = 0.005});
  const Events without = events({.lead = 0.0});
  EXPECT_LT(with.takeoff, without.takeoff);
  EXPECT_GT(with.takeoff, without.takeoff - 0.006);
  EXPECT_EQ(with.landing, without.landing);
}

TEST(LoadFilter, HasNoLeadBelow500Hz) {
  EXPECT_EQ(events({.sample_rate = 250.0, .lead = 0.02}).takeoff,
            events({.sample_rate = 250.0, .lead = 0.0}).takeoff);
}

TEST(LoadFilter, FindsTheSameEventsAtOtherRates) {
  for (const double rate : {200.0, 500.0, 2000.0}) {
    const Events found = events({.sample_rate = rate});
    EXPECT_NEAR(found.takeoff, 0.52, 0.015) << rate;
    EXPECT_NEAR(found.landing, 0.80, 0.02) << rate;
  }
}

/// Bayes' rule on two states, written down once more: probabilities instead of odds, and densities
/// integrated over the load's possible values.
class TwoStates {
 public:
  double update(double load, double deviation) {
    const double sigma = deviation / weight;
    double x = load / weight;
    if (!is_started_) smoothed_ = x;
    is_started_ = true;
    smoothed_ += (1.0 - std::exp(-0.001 / 0.004)) * (x - smoothed_);
    const double slope = std::min(0.0, (x - smoothed_) / 0.004);
    const double seconds = 0.005 / (1.0 + std::pow(sigma / 0.076, 2));
    x = std::max(x + std::max(seconds * slope, -0.38), std::min(x, 0.0));
    const double in_air = density(std::max(x, 0.0), sigma);
    double in_contact = 0.0;
    constexpr int parts = 4000;
    constexpr double lightest = 0.019;
    constexpr double heaviest = 0.76;
    for (int i = 0; i < parts; ++i) {
      const double truth = lightest + (heaviest - lightest) * (i + 0.5) / parts;
      in_contact += density(std::min(x, 0.38) - truth, sigma) / parts;
    }
    const double bound = std::exp(6.0);
    const double ratio = std::clamp(in_contact / in_air, 1.0 / bound, bound);
    const double prior = p_ * (1.0 - 0.005) + (1.0 - p_) * 0.01;
    const double by = std::sqrt(ratio);  // half of the evidence of a millisecond is new
    p_ = prior * by / (prior * by + 1.0 - prior);
    return p_;
  }

 private:
  static double density(double x, double sigma) {
    return std::exp(-0.5 * std::pow(x / sigma, 2)) / (sigma * std::sqrt(2.0 * M_PI));
  }

  double p_ = 0.5;
  double smoothed_ = 0.0;
  bool is_started_ = false;
};

TEST(LoadFilter, AppliesBayesRuleToTheLoads) {
  for (const double noise : {0.001, 0.3, 1.0}) {
    LoadFilter filter;
    DynamicLoads loads({}, 1000.0);
    std::array<TwoStates, 2> expected;
    test::Normal normal(3);
    for (int k = 0; k < 1000; ++k) {
      const double time = 0.001 * k;
      Signals signals = carrying(time, load_at(time), 26.0 - 0.5 * load_at(time));
      for (LegSignals& leg : signals.leg) {
        for (JointSignals* joint : {&leg.hip, &leg.knee}) joint->torque += noise * normal();
      }
      const Belief& belief = filter.update(signals);
      const DynamicLoads::Loads found = loads.update(signals, true);
      for (std::size_t side = 0; side < 2; ++side) {
        const double p = expected[side].update(found[side].force, found[side].deviation);
        EXPECT_NEAR(belief.wheel[side].p_contact, p, 1e-3) << noise << ' ' << k;
      }
    }
  }
}

TEST(LoadFilter, LeavesAndReturnsAtItsThresholds) {
  LoadFilter filter;
  bool was_in_contact = false;
  int changes = 0;
  for (int k = 0; k < 1000; ++k) {
    const double time = 0.001 * k;
    const WheelBelief wheel = filter.update(carrying(time, load_at(time), 26.0)).wheel[0];
    if (wheel.contact != was_in_contact) ++changes;
    const bool expected = wheel.p_contact < 0.02   ? false
                          : wheel.p_contact > 0.85 ? true
                                                   : was_in_contact;
    EXPECT_EQ(wheel.contact, expected) << k;
    was_in_contact = wheel.contact;
  }
  EXPECT_EQ(changes, 3);
}

TEST(LoadFilter, ReportsALoadThatChangesWithTheDeviationOfItsLag) {
  const double weight = 9.81 * LegGeometry{}.robot_mass;
  for (const double frequency : {2.0, 5.0, 10.0}) {
    LoadFilter filter;
    for (int k = 0; k < 1000; ++k) {
      const double time = 0.001 * k;
      const double left = weight * (0.5 + 0.4 * std::sin(6.283 * frequency * time));
      const WheelLoad load = filter.update(carrying(time, left, weight - left)).wheel[0].load;
      if (k < 200) continue;
      EXPECT_NEAR(load.force, left, 2.0 * load.deviation) << frequency << " Hz";
    }
  }
}

TEST(LoadFilter, TakesForStraightLegsWhatTheAccelerometerKnows) {
  LoadFilter filter;
  Signals straight;
  const auto after = [&](double acceleration) {
    for (int k = 0; k < 1000; ++k) {
      straight.time += 0.001;
      straight.vertical_acceleration = acceleration + 1e-9 * (k % 2);
      filter.update(straight);
    }
    return filter.update(straight);
  };
  Belief belief = after(0.0);  // one wheel, or both: which is not known
  EXPECT_TRUE(belief.wheel[0].contact);
  EXPECT_TRUE(std::isnan(belief.wheel[0].load.force));
  EXPECT_TRUE(is_used(belief.status));
  belief = after(-9.81);
  EXPECT_FALSE(belief.wheel[0].contact);
  EXPECT_NEAR(belief.wheel[0].load.force, 0.0, 1.0);
}

TEST(LoadFilter, IsDegradedWithoutTheTargetsOfServos) {
  LoadFilter filter;
  Signals signals = carrying(0.0, 26.0, 26.0);
  EXPECT_EQ(filter.update(signals).status, SignalStatus::degraded);
  for (std::size_t side = 0; side < 2; ++side) {
    signals.target[side] = test::targets_of(signals.leg[side]);
  }
  signals.time = 0.001;
  EXPECT_EQ(filter.update(signals).status, SignalStatus::good);
  signals.time = 0.002;
  signals.target[1].knee.kp = 0.0;
  EXPECT_EQ(filter.update(signals).status, SignalStatus::degraded);
}

/// The filter after 300 ms on the ground.
LoadFilter on_the_ground() {
  LoadFilter filter;
  for (int k = 0; k < 300; ++k) filter.update(carrying(0.001 * k, 26.0, 26.0));
  return filter;
}

TEST(LoadFilter, RelaxesForALegWithoutSignals) {
  LoadFilter filter = on_the_ground();
  Belief belief;
  for (int k = 300; k < 1300; ++k) {
    Signals signals = carrying(0.001 * k, 26.0, 26.0);
    signals.leg[1].knee.torque = std::nan("");
    belief = filter.update(signals);
    EXPECT_EQ(belief.status, SignalStatus::invalid);
    EXPECT_TRUE(std::isnan(belief.wheel[1].load.force));
  }
  EXPECT_GT(belief.wheel[0].p_contact, 0.99);
  EXPECT_NEAR(belief.wheel[1].p_contact, 0.5, 0.01);
  EXPECT_TRUE(belief.wheel[1].contact);  // the last decision
  for (int k = 1300; k < 1310; ++k) belief = filter.update(carrying(0.001 * k, 26.0, 26.0));
  EXPECT_TRUE(is_used(belief.status));
  EXPECT_GT(belief.wheel[1].p_contact, 0.99);
}

TEST(LoadFilter, RelaxesOverAGapAndStartsAnew) {
  LoadFilter filter = on_the_ground();
  const Belief after = filter.update(carrying(10.0, 0.0, 26.0));
  EXPECT_EQ(after.status, SignalStatus::gap);
  EXPECT_LT(after.wheel[0].p_contact, 0.5);
  EXPECT_GT(after.wheel[1].p_contact, 0.5);
  EXPECT_LT(after.wheel[1].p_contact, 0.999);
}

TEST(LoadFilter, GivesNoBeliefBeyondTheFlatPriorWithoutAnImu) {
  LoadFilter filter = on_the_ground();
  Belief belief;
  for (int k = 300; k < 1300; ++k) {
    Signals signals = carrying(0.001 * k, 26.0, 26.0);
    signals.up.setConstant(std::nan(""));
    belief = filter.update(signals);
  }
  EXPECT_EQ(belief.status, SignalStatus::invalid);
  EXPECT_NEAR(belief.p_both_wheels, 0.25, 0.01);
}

TEST(LoadFilter, RepeatsItselfToTheBitAfterAReset) {
  LoadFilter filter;
  const auto run = [&] {
    std::vector<double> beliefs;
    test::Normal normal(5);
    for (int k = 0; k < 800; ++k) {
      Signals signals = carrying(0.001 * k, load_at(0.001 * k), 26.0);
      signals.leg[0].knee.torque += 0.5 * normal();
      const Belief& belief = filter.update(signals);
      beliefs.push_back(belief.wheel[0].p_contact);
      beliefs.push_back(belief.wheel[0].load.deviation);
    }
    return beliefs;
  };
  const std::vector<double> first = run();
  filter.reset();
  EXPECT_EQ(run(), first);
}

TEST(LoadFilter, RefusesInvalidValues) {
  const auto refused = [](const LoadFilterConfig& config) {
    EXPECT_THROW(LoadFilter{config}, InputError);
  };
  refused({.sample_rate = 0.0});
  refused({.geometry = {.lower_length = 0.0}});
  refused({.geometry = {.robot_mass = 0.0}});
  refused({.lead = -1.0});
  refused({.leave_below = 0.0});
  refused({.leave_below = 0.9, .return_above = 0.8});
  refused({.return_above = 1.0});
  refused({.lead = std::numeric_limits<double>::quiet_NaN()});
}

}  // namespace
}  // namespace touchdown
