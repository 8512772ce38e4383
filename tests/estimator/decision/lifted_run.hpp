#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "estimator/contact_estimator.hpp"
#include "estimator/decision/fit.hpp"
#include "tests/estimator/force/carried_run.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown::test {

/// Without passes at a lower rate: one step in five gives little information on loads that jump
/// within a step.
inline constexpr DecisionFitConfig quick = {
    .passes = 8, .rows = 80'000, .share_slow = 0.0, .batch = 256, .epochs = 24};

/// A robot that in turn stands, lifts its left wheel, its right wheel, falls and is lifted, with a
/// little noise.
inline CarriedRun lifted_run(int rounds, std::uint32_t seed, double noise = 0.02) {
  Normal normal(seed);
  CarriedRun run;
  const auto add_steps = [&](double left, double right, double acceleration, int steps) {
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
      run.label(left > 1.0, right > 1.0);
    }
  };
  for (int round = 0; round < rounds; ++round) {
    add_steps(26.0, 26.0, 0.0, 300);
    add_steps(0.0, 52.0, 0.0, 150);
    add_steps(26.0, 26.0, 0.0, 250);
    add_steps(52.0, 0.0, 0.0, 150);
    add_steps(20.0, 20.0, 0.0, 250);
    add_steps(0.0, 0.0, -9.81, 150);
    add_steps(35.0, 35.0, 1.0, 250);
    add_steps(0.0, 0.0, 0.3, 200);
  }
  return run;
}

/// A network fitted to four rounds of it.
inline const DecisionModel& lifted_network() {
  static const DecisionModel model = [] {
    const CarriedRun run = lifted_run(4, 1);
    return fit_decision_model(std::vector<LabelledRun>{run.view()}, {}, quick);
  }();
  return model;
}

/// The accuracy over a run's steps and wheels.
inline double accuracy(ContactEstimator& estimator, const CarriedRun& run) {
  std::size_t correct = 0;
  for (std::size_t k = 0; k < run.signals.size(); ++k) {
    const Belief& belief = estimator.update(run.signals[k]);
    for (std::size_t w = 0; w < 2; ++w) {
      correct += belief.wheel[w].contact == (run.contact[w][k] != 0) ? 1 : 0;
    }
  }
  return static_cast<double>(correct) / static_cast<double>(2 * run.signals.size());
}

/// Wheels with random labels, three in four in contact, and loads that overlap between the classes.
inline CarriedRun overlapping_loads(Normal& normal) {
  CarriedRun run;
  for (int k = 0; k < 20'000; ++k) {
    const std::array<bool, 2> in_contact = {normal() < 0.6745, normal() < 0.6745};
    run.add(in_contact[0] ? 8.0 + 4.0 * normal() : 4.0 * normal(),
            in_contact[1] ? 8.0 + 4.0 * normal() : 4.0 * normal());
    run.label(in_contact[0], in_contact[1]);
  }
  return run;
}

}  // namespace touchdown::test
