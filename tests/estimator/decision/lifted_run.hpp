#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "estimator/contact_estimator.hpp"
#include "estimator/decision/fit.hpp"
#include "tests/estimator/force/carried_run.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown::test {

/// Heard at one rate alone: loads that jump within a step say little to who hears one in five.
inline constexpr DecisionFitConfig quick = {
    .passes = 8, .rows = 80'000, .share_slow = 0.0, .batch = 256, .epochs = 24};

/// A robot that stands, lifts its left wheel, its right one, falls, is lifted, in turn, with a
/// little noise.
inline CarriedRun lifted_run(int rounds, std::uint32_t seed, double noise = 0.02) {
  Normal normal(seed);
  CarriedRun run;
  const auto go_on = [&](double left, double right, double acceleration, int steps) {
    for (int k = 0; k < steps; ++k) {
      Signals& s = run.add(left, right, acceleration);
      for (LegSignals& leg : s.leg) {
        for (JointSignals* joint : {&leg.hip, &leg.knee, &leg.wheel}) {
          joint->torque += noise * normal();
        }
      }
      s.vertical_acceleration += 0.1 * normal();
      s.angular_velocity.x() = left == right ? 0.02 * normal() : 0.3 + 0.02 * normal();
      if (left > right) s.angular_velocity.x() *= -1.0;
      run.touch(left > 1.0, right > 1.0);
    }
  };
  for (int round = 0; round < rounds; ++round) {
    go_on(26.0, 26.0, 0.0, 300);
    go_on(0.0, 52.0, 0.0, 150);
    go_on(26.0, 26.0, 0.0, 250);
    go_on(52.0, 0.0, 0.0, 150);
    go_on(20.0, 20.0, 0.0, 250);
    go_on(0.0, 0.0, -9.81, 150);
    go_on(35.0, 35.0, 1.0, 250);
    go_on(0.0, 0.0, 0.3, 200);
  }
  return run;
}

/// What is fitted to some of it.
inline const DecisionModel& lifted_network() {
  static const DecisionModel model = [] {
    const CarriedRun run = lifted_run(4, 1);
    return fit_decision_model(std::vector<LabelledRun>{run.view()}, {}, quick);
  }();
  return model;
}

/// In how many of a run's steps and wheels contact is told right.
inline double share_right(ContactEstimator& estimator, const CarriedRun& run) {
  std::size_t right = 0;
  for (std::size_t k = 0; k < run.signals.size(); ++k) {
    const Belief& belief = estimator.update(run.signals[k]);
    for (std::size_t w = 0; w < 2; ++w) {
      right += belief.wheel[w].contact == (run.contact[w][k] != 0) ? 1 : 0;
    }
  }
  return static_cast<double>(right) / static_cast<double>(2 * run.signals.size());
}

/// Wheels that carry something between nothing and a little: a coin's class, three in four contact.
inline CarriedRun overlapping_loads(Normal& normal) {
  CarriedRun run;
  for (int k = 0; k < 20'000; ++k) {
    const std::array<bool, 2> touches = {normal() < 0.6745, normal() < 0.6745};
    run.add(touches[0] ? 8.0 + 4.0 * normal() : 4.0 * normal(),
            touches[1] ? 8.0 + 4.0 * normal() : 4.0 * normal());
    run.touch(touches[0], touches[1]);
  }
  return run;
}

/// Whatever it hears, beliefs are probabilities.
inline void expect_never_lost(ContactEstimator& estimator) {
  constexpr double huge = std::numeric_limits<double>::max();
  Signals s = lifted_run(1, 9).signals.front();
  for (const double extreme : {huge, -huge, 1e308, 1e4, -1e4, 0.0}) {
    for (int k = 0; k < 50; ++k) {
      s.time += 0.001;
      s.vertical_acceleration = 0.5 * k;
      s.angular_velocity.setConstant(extreme);
      for (LegSignals& leg : s.leg) {
        for (JointSignals* joint : {&leg.hip, &leg.knee, &leg.wheel}) {
          *joint = {extreme, extreme, std::clamp(extreme, -1e4, 1e4)};
        }
      }
      for (const WheelBelief& wheel : estimator.update(s).wheel) {
        ASSERT_TRUE(wheel.p_contact >= 0.0 && wheel.p_contact <= 1.0) << extreme;
      }
    }
  }
}

}  // namespace touchdown::test
