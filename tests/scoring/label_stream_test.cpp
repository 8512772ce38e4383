#include <random>

#include <gtest/gtest.h>

#include "scoring/labels.hpp"

namespace touchdown::scoring {
namespace {

constexpr double period = 0.001;

struct Streamed {
  ContactSequence labels;
  std::size_t largest_delay = 0;
};

Streamed stream(const std::vector<double>& force, const LabelConfig& config) {
  Streamed result;
  LabelStream labels(period, config,
                     [&](std::uint8_t contact) { result.labels.push_back(contact); });
  for (std::size_t k = 0; k < force.size(); ++k) {
    labels.add(force[k]);
    result.largest_delay = std::max(result.largest_delay, k + 1 - result.labels.size());
  }
  labels.finish();
  return result;
}

TEST(LabelStream, LabelsLikeTheWholeSequence) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    // Intervals of chatter and of constant contact.
    std::vector<double> force;
    const std::size_t steps = random() % 400;
    while (force.size() < steps) {
      const std::size_t length = 1 + random() % (random() % 4 == 0 ? 40 : 7);
      force.insert(force.end(), length, random() % 2 == 0 ? 0.0 : 26.0);
    }
    for (const double debounce : {0.0, 0.001, 0.005, 0.02}) {
      const LabelConfig config{1.0, debounce};
      ASSERT_EQ(stream(force, config).labels, contact_labels(force, period, config))
          << "trial " << trial << ", debounce " << debounce;
    }
  }
}

TEST(LabelStream, LabelsConstantStatesWithShortDelay) {
  std::vector<double> force(10'000, 26.0);
  for (std::size_t k = 5000; k < 5100; ++k) force[k] = k % 2 == 0 ? 0.0 : 26.0;
  EXPECT_LE(stream(force, {}).largest_delay, 105U);
}

TEST(LabelStream, GivesNoLabelsWithoutForces) { EXPECT_TRUE(stream({}, {}).labels.empty()); }

TEST(LabelStream, LabelsEndlessChatterAfterAMinute) {
  std::vector<double> force(200'000);
  for (std::size_t k = 0; k < force.size(); ++k) force[k] = k % 4 < 2 ? 0.0 : 26.0;
  const Streamed result = stream(force, {});
  EXPECT_EQ(result.labels.size(), force.size());
  EXPECT_LE(result.largest_delay, 60'010U);
}

}  // namespace
}  // namespace touchdown::scoring
