#include "scoring/score_stream.hpp"

#include <random>

#include <gtest/gtest.h>

namespace touchdown::scoring {
namespace {

/// A run of random flights, and beliefs with delays, chatter and missed flights.
struct NoisyRun {
  std::array<std::vector<double>, models::wheel_count> force;
  std::vector<Belief> belief;
};

NoisyRun random_run(unsigned seed, std::size_t steps, std::size_t longest_quiet) {
  std::mt19937 random(seed);
  NoisyRun run;
  for (std::vector<double>& force : run.force) {
    while (force.size() < steps) {
      force.insert(force.end(), 1 + random() % longest_quiet, 26.0);
      force.insert(force.end(), 1 + random() % 300, random() % 5 == 0 ? 26.0 : 0.0);
    }
    force.resize(steps);
  }
  for (std::size_t k = 0; k < steps; ++k) {
    Belief belief;
    for (std::size_t wheel = 0; wheel < 2; ++wheel) {
      const std::size_t lag = 20 + wheel * 7;
      const bool in_contact = run.force[wheel][k < lag ? 0 : k - lag] > 1.0;
      const bool contact = random() % 2000 == 0 ? !in_contact : in_contact;
      belief.wheel[wheel] = {contact ? 0.9 : 0.2, contact};
    }
    belief.p_any_wheel = 0.95;
    belief.p_both_wheels = 0.4;
    run.belief.push_back(belief);
  }
  return run;
}

RobotScore whole(const NoisyRun& run) {
  std::array<ContactSequence, models::wheel_count> truth;
  Prediction prediction;
  for (std::size_t wheel = 0; wheel < 2; ++wheel) {
    truth[wheel] = contact_labels(run.force[wheel], 0.001, {});
  }
  for (const Belief& belief : run.belief) {
    const bool left = belief.wheel[0].contact;
    const bool right = belief.wheel[1].contact;
    const std::array<bool, 4> contact = {left, right, left || right, left && right};
    const std::array<double, 4> p = {belief.wheel[0].p_contact, belief.wheel[1].p_contact,
                                     belief.p_any_wheel, belief.p_both_wheels};
    for (std::size_t v = 0; v < view_count; ++v) {
      prediction[v].contact.push_back(contact[v] ? 1 : 0);
      prediction[v].p_contact.push_back(p[v]);
    }
  }
  return score(truth, prediction, {0}, 1000, {}).front();
}

RobotScore streamed(const NoisyRun& run) {
  ScoreStream stream(1000, {}, {});
  for (std::size_t k = 0; k < run.belief.size(); ++k) {
    stream.add({run.force[0][k], run.force[1][k]}, run.belief[k]);
  }
  return stream.finish();
}

void expect_equal(const RobotScore& a, const RobotScore& b) {
  for (std::size_t v = 0; v < view_count; ++v) {
    EXPECT_EQ(a.view[v].points, b.view[v].points);
    EXPECT_EQ(a.view[v].takeoff, b.view[v].takeoff);
    EXPECT_EQ(a.view[v].landing, b.view[v].landing);
    EXPECT_NEAR(a.view[v].calibration.brier(), b.view[v].calibration.brier(), 1e-12);
    EXPECT_EQ(a.view[v].calibration.points, b.view[v].calibration.points);
  }
}

TEST(ScoreStream, ScoresLongRunsAsAWhole) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const NoisyRun run = random_run(seed, 90'000, 5000);
    const RobotScore expected = whole(run);
    EXPECT_GT(expected.view[0].takeoff.events, 10);
    EXPECT_GT(expected.view[0].takeoff.false_alarms, 5);
    expect_equal(streamed(run), expected);
  }
}

TEST(ScoreStream, ScoresRunsWithoutAConstantIntervalAsAWhole) {
  const NoisyRun run = random_run(1, 60'000, 300);
  expect_equal(streamed(run), whole(run));
}

TEST(ScoreStream, ScoresShortRuns) {
  for (const std::size_t steps : {1U, 100U, 301U, 2000U}) {
    const NoisyRun run = random_run(2, steps, 400);
    const RobotScore expected = whole(run);
    const RobotScore got = streamed(run);
    for (std::size_t v = 0; v < view_count; ++v) {
      EXPECT_EQ(got.view[v].points, expected.view[v].points);
      EXPECT_EQ(got.view[v].takeoff, expected.view[v].takeoff);
    }
  }
}

}  // namespace
}  // namespace touchdown::scoring
