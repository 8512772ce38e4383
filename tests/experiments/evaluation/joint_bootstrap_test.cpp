#include "experiments/evaluation/joint_bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

using ::testing::Each;
using ::testing::IsEmpty;

const scoring::BootstrapConfig many = {.resamples = 20'000};

/// A run of contact alone.
scoring::Classification run_with(std::int64_t right, std::int64_t wrong) {
  return {.contact_as_contact = right, .contact_as_flight = wrong};
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST(JointBootstrap, OfASingleRunHasNoInterval) {
  const Resampled alone = balanced_accuracy({{run_with(9, 1)}}, 0, many);
  EXPECT_EQ(alone.estimate, 0.9);
  EXPECT_THAT(alone.values, IsEmpty());
  EXPECT_TRUE(std::isnan(interval_of(alone, 0.95).low));
}

TEST(JointBootstrap, HasTheVarianceOfAMeanOfFewRuns) {
  const std::vector<std::int64_t> right = {90, 95, 70, 99, 85, 60};
  FitsAndRuns scores;
  for (const std::int64_t points : right) scores.runs.push_back(run_with(points, 100 - points));
  const Resampled resampled = balanced_accuracy(scores, 0, many);
  // s²/n, with the unbiased s² of the runs' shares.
  const auto n = static_cast<double>(right.size());
  double mean = 0.0;
  for (const std::int64_t points : right) mean += 0.01 * static_cast<double>(points) / n;
  double squares = 0.0;
  for (const std::int64_t points : right) {
    squares += std::pow(0.01 * static_cast<double>(points) - mean, 2);
  }
  const double expected = squares / (n - 1.0) / n;
  double variance = 0.0;
  for (const double value : resampled.values) variance += std::pow(value - mean, 2);
  variance /= static_cast<double>(resampled.values.size());
  EXPECT_NEAR(resampled.estimate, mean, 1e-12);
  EXPECT_NEAR(variance, expected, 0.03 * expected);
}

/// Of two refits one is always right and the other never.
FitsAndRuns of_two_refits() {
  FitsAndRuns scores{{run_with(8, 2), run_with(8, 2)}};
  scores.of_refit = {{run_with(10, 0), run_with(10, 0)}, {run_with(0, 10), run_with(0, 10)}};
  return scores;
}

TEST(JointBootstrap, DrawsARefitForEveryResample) {
  const Resampled resampled = balanced_accuracy(of_two_refits(), 0, many);
  EXPECT_EQ(resampled.estimate, 0.8);  // of the fit itself
  EXPECT_THAT(resampled.values, Each(::testing::AnyOf(0.0, 1.0)));
  EXPECT_NEAR(mean_of(resampled.values), 0.5, 0.02);
}

TEST(JointBootstrap, DrawsTheSameRefitInEveryScene) {
  EXPECT_EQ(balanced_accuracy(of_two_refits(), 0, many).values,
            balanced_accuracy(of_two_refits(), 7, many).values);
}

TEST(JointBootstrap, DrawsTheRunsOfEverySceneIndependently) {
  const FitsAndRuns scores{{run_with(10, 0), run_with(0, 10)}};
  const std::vector<double> one = balanced_accuracy(scores, 0, many).values;
  const std::vector<double> other = balanced_accuracy(scores, 1, many).values;
  double both = 0.0;
  for (std::size_t r = 0; r < one.size(); ++r) both += one[r] * other[r];
  EXPECT_NEAR(both / static_cast<double>(one.size()), 0.25, 0.02);
  EXPECT_EQ(one, balanced_accuracy(scores, 0, many).values);
}

TEST(JointBootstrap, AddsResampleByResample) {
  const Resampled one{0.5, {0.4, 0.6}};
  const Resampled other{1.0, {1.0, 0.8}};
  const Resampled both = mean({&one, &other});
  EXPECT_DOUBLE_EQ(both.estimate, 0.75);
  ASSERT_EQ(both.values.size(), 2U);
  EXPECT_DOUBLE_EQ(both.values[0], 0.7);
  EXPECT_DOUBLE_EQ(both.values[1], 0.7);
  const Resampled alone{0.9, {}};
  EXPECT_THAT(mean({&one, &alone}).values, IsEmpty());
}

}  // namespace
}  // namespace touchdown::experiments
