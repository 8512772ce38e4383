#include "experiments/evaluation/joint_bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.hpp"

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
  CountsByFit scores(1);
  for (const std::int64_t points : right) scores[0].push_back(run_with(points, 100 - points));
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
CountsByFit of_two_refits() {
  return {{run_with(8, 2), run_with(8, 2)},
          {run_with(10, 0), run_with(10, 0)},
          {run_with(0, 10), run_with(0, 10)}};
}

TEST(JointBootstrap, DrawsARefitForEveryResample) {
  const Resampled resampled = balanced_accuracy(of_two_refits(), 0, many);
  EXPECT_EQ(resampled.estimate, 0.8);  // of the fit itself
  // The refits are 0.3 worse on average, which is added; a share is at most 1.
  EXPECT_THAT(resampled.values, Each(::testing::AnyOf(::testing::DoubleEq(0.3), 1.0)));
  EXPECT_NEAR(mean_of(resampled.values), 0.65, 0.02);
}

TEST(JointBootstrap, HoldsTheEstimateThoughRefitsAreWorse) {
  // Refits to fewer different runs are worse by 0.02 on average, and scatter by less.
  for (const std::int64_t lost : {0, 20, 60}) {
    CountsByFit scores(1);
    for (const std::int64_t right : {900, 890, 905, 880, 895, 915}) {
      scores[0].push_back(run_with(right, 1000 - right));
    }
    for (const std::int64_t refit : {-5, -2, 0, 2, 5}) {
      std::vector<scoring::Classification> runs;
      for (const scoring::Classification& run : scores[0]) {
        const std::int64_t right = run.contact_as_contact - lost + refit;
        runs.push_back(run_with(right, 1000 - right));
      }
      scores.push_back(runs);
    }
    const Resampled resampled = balanced_accuracy(scores, 0, many);
    const Interval interval = interval_of(resampled, 0.95);
    EXPECT_NEAR(mean_of(resampled.values), resampled.estimate, 1e-3) << lost;
    EXPECT_LT(interval.low, resampled.estimate - 0.004) << lost;
    EXPECT_GT(interval.high, resampled.estimate + 0.004) << lost;
  }
}

/// Normal, of zero mean and unit variance.
double normal(std::uint64_t key, std::uint64_t i, std::uint64_t k) {
  const double radius = std::sqrt(-2.0 * std::log(uniform01(key, i, 2 * k)));
  return radius * std::cos(2.0 * std::numbers::pi * uniform01(key, i, 2 * k + 1));
}

TEST(JointBootstrap, OverScenesHasTheTwoLevelVariance) {
  // Scenes σ_b apart, m runs of each σ_w apart: their mean has the variance (σ_b² + σ_w²/m)/n. The
  // mean of many data sets' bootstrap variances has to be that, wherever the scatter comes from.
  constexpr int scene_count = 10;
  constexpr int run_count = 4;
  constexpr std::uint64_t data_sets = 400;
  const scoring::BootstrapConfig few = {.resamples = 200};
  struct Scatter {
    double of_scenes;
    double of_runs;
  };
  for (const Scatter& scatter : {Scatter{0.02, 0.0}, {0.0, 0.04}, {0.02, 0.04}}) {
    double variance = 0.0;
    for (std::uint64_t data = 0; data < data_sets; ++data) {
      std::vector<Resampled> values;
      for (std::uint64_t scene = 0; scene < scene_count; ++scene) {
        const double of_scene = 0.8 + scatter.of_scenes * normal(data, scene, 1000);
        CountsByFit scores(1);
        for (std::uint64_t run = 0; run < run_count; ++run) {
          const double share = of_scene + scatter.of_runs * normal(data, scene, run);
          const std::int64_t right = std::llround(1e6 * share);
          scores[0].push_back(run_with(right, 1'000'000 - right));
        }
        values.push_back(balanced_accuracy(scores, scene, few));
      }
      std::vector<SceneValues> scenes;
      for (const Resampled& one : values) scenes.push_back({one});
      const Resampled mean = mean_over_scenes(scenes, few);
      ASSERT_EQ(mean.values.size(), 200U);
      for (const double value : mean.values) {
        variance += std::pow(value - mean.estimate, 2) / 200.0 / data_sets;
      }
    }
    const double expected =
        (std::pow(scatter.of_scenes, 2) + std::pow(scatter.of_runs, 2) / run_count) / scene_count;
    EXPECT_NEAR(variance, expected, 0.07 * expected) << scatter.of_scenes << scatter.of_runs;
  }
}

TEST(JointBootstrap, OfOneSceneResamplesItsRuns) {
  const Resampled one{0.5, {0.4, 0.6}};
  const Resampled other{1.0, {1.0, 0.8}};
  EXPECT_EQ(mean_over_scenes({{one, other}}, many).values, mean({&one, &other}).values);
}

TEST(JointBootstrap, DrawsTheSameRefitInEveryScene) {
  EXPECT_EQ(balanced_accuracy(of_two_refits(), 0, many).values,
            balanced_accuracy(of_two_refits(), 7, many).values);
}

TEST(JointBootstrap, DrawsTheRunsOfEverySceneIndependently) {
  const CountsByFit scores = {{run_with(10, 0), run_with(0, 10)}};
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

TEST(JointBootstrap, OfFitsOfEqualRankAveragesThemAndItsIntervalCoversThem) {
  const auto runs_of = [](std::int64_t right) {
    scoring::Classification points;
    points.contact_as_contact = right;
    points.contact_as_flight = 100 - right;
    return std::vector<scoring::Classification>(3, points);  // runs without any difference
  };
  const Resampled resampled = balanced_accuracy_of_fits({runs_of(60), runs_of(100)}, 0, {});
  const Interval interval = interval_of(resampled, 0.95);
  EXPECT_DOUBLE_EQ(interval.estimate, 0.8);
  EXPECT_DOUBLE_EQ(interval.low, 0.6);
  EXPECT_DOUBLE_EQ(interval.high, 1.0);
}

}  // namespace
}  // namespace touchdown::experiments
