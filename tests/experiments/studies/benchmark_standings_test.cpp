#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/studies/benchmark.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;

constexpr std::size_t resamples = 20'000;
const scoring::BootstrapConfig intervals = {.resamples = resamples};

/// Normal values around the estimate, a stream of their own for each key.
Resampled normal(double estimate, double error, std::uint64_t key) {
  Resampled all{estimate};
  for (std::size_t r = 0; r < resamples; ++r) {
    const double radius = std::sqrt(-2.0 * std::log(uniform01(key, 0, r)));
    const double angle = 2.0 * std::numbers::pi * uniform01(key, 1, r);
    all.values.push_back(estimate + error * radius * std::cos(angle));
  }
  return all;
}

BenchmarkRow row(const std::string& scene, const std::string& estimator, Resampled accuracy,
                 const std::string& simulator = "mujoco") {
  BenchmarkRow row;
  row.simulator = simulator;
  row.robot = "upkie";
  row.sensors = "ideal";
  row.scene = scene;
  row.estimator = estimator;
  row.fitted_on = "own";
  row.balanced_accuracy = std::move(accuracy);
  return row;
}

TEST(Standings, PutTheBestMeanFirstAndNameTheWorstScene) {
  const auto all = standings({row("stairs", "a", {0.9}), row("kerb", "a", {0.5}, "bullet"),
                              row("stairs", "b", {0.7}), row("kerb", "b", {0.8}, "bullet")},
                             intervals);
  ASSERT_EQ(all.size(), 1U);
  ASSERT_EQ(all[0].entries.size(), 2U);
  EXPECT_EQ(all[0].entries[0].estimator, "b");
  EXPECT_DOUBLE_EQ(all[0].entries[0].mean.estimate, 0.75);
  EXPECT_EQ(all[0].entries[1].worst, 0.5);
  EXPECT_EQ(all[0].entries[1].worst_scene, "kerb");
  EXPECT_EQ(all[0].entries[1].worst_simulator, "bullet");
}

TEST(Standings, HaveTheMeanLogLossOfTheScenes) {
  const auto row_with = [](const std::string& scene, double bits) {
    BenchmarkRow one = row(scene, "a", {0.9});
    one.extended.steps = 1000;
    one.extended.log_loss = 1000.0 * bits * std::numbers::ln2;
    return one;
  };
  const auto all = standings({row_with("stairs", 0.25), row_with("kerb", 0.75)}, intervals);
  EXPECT_NEAR(all.at(0).entries.at(0).log_loss, 0.5, 1e-12);
}

TEST(Standings, AreSeparateForEverySetupAndOfInDomainFitsAlone) {
  std::vector<BenchmarkRow> rows = {row("stairs", "a", {0.9}), row("stairs", "b", {0.8})};
  BenchmarkRow harsh = row("stairs", "a", {0.6});
  harsh.sensors = "harsh";
  BenchmarkRow noisy = row("stairs", "a", {0.7});
  noisy.noise = {1.0, 5.0};
  BenchmarkRow transferred = row("stairs", "a", {0.1});
  transferred.fitted_on = "bullet";
  rows.insert(rows.end(), {harsh, noisy, transferred});
  const auto all = standings(rows, intervals);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].entries[0].mean.estimate, 0.9);
  EXPECT_EQ(all[1].sensors, "harsh");
  EXPECT_EQ(all[2].noise.torque, 1.0);
}

TEST(Standings, LeaveOutEstimatorsThatWereNotScoredInAllRuns) {
  BenchmarkRow stairs = row("stairs", "ours", {0.9});
  BenchmarkRow kerb = row("kerb", "ours", {0.5});
  BenchmarkRow partly = row("stairs", "theirs", {1.0});
  for (BenchmarkRow* one : {&stairs, &kerb, &partly}) one->runs = 4;
  const auto some_scenes = standings({stairs, kerb, partly}, intervals);
  ASSERT_EQ(some_scenes.at(0).entries.size(), 1U);
  EXPECT_EQ(some_scenes[0].entries[0].estimator, "ours");
  BenchmarkRow few = row("kerb", "theirs", {1.0});
  few.runs = 3;
  EXPECT_EQ(standings({stairs, kerb, partly, few}, intervals).at(0).entries.size(), 1U);
}

TEST(Standings, BandOfOnePairIsTheNormalOne) {
  const auto all = standings(
      {row("stairs", "a", normal(0.9, 0.03, 1)), row("stairs", "b", normal(0.8, 0.04, 2))},
      intervals);
  ASSERT_EQ(all[0].differences.size(), 2U);  // the mean, and the only scene
  const Interval& band = all[0].differences[0].value;
  EXPECT_NEAR(band.estimate, 0.1, 1e-12);
  EXPECT_NEAR(band.high - band.estimate, 1.96 * 0.05, 0.003);
  EXPECT_NEAR(band.estimate - band.low, 1.96 * 0.05, 0.003);
}

TEST(Standings, BandsOfManyPairsHoldTogether) {
  // Twelve equally good estimators with independent values: the largest of their 66 differences is
  // the range of twelve normal values. The upper five per cent of the studentised range of twelve
  // is 4.62 (tables of Tukey's test, infinitely many degrees of freedom).
  std::vector<BenchmarkRow> rows;
  for (int i = 0; i < 12; ++i) {
    rows.push_back(row("stairs", std::string(1, static_cast<char>('a' + i)),
                       normal(0.9, 0.01, static_cast<std::uint64_t>(100 + i))));
  }
  const auto all = standings(rows, intervals);
  for (const Standings::Difference& pair : all[0].differences) {
    EXPECT_NEAR(pair.value.high - pair.value.estimate, 4.62 * 0.01, 0.0015);
  }
}

TEST(Standings, MarkEstimatorsThatAreNotSignificantlyWorse) {
  const auto all = standings({row("stairs", "best", normal(0.95, 0.005, 1)),
                              row("stairs", "near", normal(0.945, 0.005, 2)),
                              row("stairs", "far", normal(0.85, 0.005, 3))},
                             intervals);
  std::vector<bool> marks;
  for (const Standings::Entry& entry : all[0].entries)
    marks.push_back(entry.is_not_significantly_worse);
  EXPECT_THAT(marks, ElementsAre(true, true, false));
}

TEST(Standings, PairedDifferencesAreSurerThanTheirParts) {
  // Both are as good as the run is easy: they differ by the same in every resample.
  const Resampled one = normal(0.9, 0.05, 1);
  Resampled other = one;
  other.estimate -= 0.01;
  for (double& value : other.values) value -= 0.01;
  const auto all = standings({row("stairs", "a", one), row("stairs", "b", other)}, intervals);
  EXPECT_FALSE(all[0].entries[1].is_not_significantly_worse);
  EXPECT_GT(all[0].entries[0].mean.high, all[0].entries[0].mean.low + 0.1);
}

TEST(Standings, OverScenesHaveTheVarianceOfTheirScenes) {
  // The mean of n scenes, s² apart, has the variance s²/n, however sure each of them is.
  const std::vector<double> of_scene = {0.99, 0.95, 0.90, 0.99, 0.70, 0.98, 0.97, 0.93};
  std::vector<BenchmarkRow> rows;
  for (std::size_t i = 0; i < of_scene.size(); ++i) {
    rows.push_back(row("scene" + std::to_string(i), "a", normal(of_scene[i], 1e-4, i)));
    rows.push_back(row("scene" + std::to_string(i), "b", normal(of_scene[i] - 0.01, 1e-4, i)));
  }
  const auto n = static_cast<double>(of_scene.size());
  double mean = 0.0;
  for (const double value : of_scene) mean += value / n;
  double squares = 0.0;
  for (const double value : of_scene) squares += (value - mean) * (value - mean);
  const double error = std::sqrt(squares / (n - 1.0) / n);
  const Standings all = standings(rows, intervals).at(0);
  const Interval& first = all.entries.at(0).mean;
  EXPECT_NEAR(first.estimate, mean, 1e-12);
  EXPECT_NEAR((first.high - first.low) / (2.0 * 1.96), error, 0.1 * error);
  // The second is worse by the same in every scene: the pair is surer than its parts.
  EXPECT_FALSE(all.entries.at(1).is_not_significantly_worse);
}

TEST(Standings, AreInTheOrderOfF1AndPoolEventsOverScenes) {
  const auto with_events = [](const std::string& scene, const std::string& estimator,
                              double accuracy, std::int64_t matched, std::int64_t truth) {
    BenchmarkRow one = row(scene, estimator, {accuracy});
    one.score.events.truth = one.score.events.decided = truth;
    one.score.events.matched = matched;
    return one;
  };
  const auto entries = standings({with_events("stairs", "accurate", 0.99, 10, 20),
                                  with_events("kerb", "accurate", 0.99, 2, 4),
                                  with_events("stairs", "punctual", 0.95, 19, 20),
                                  with_events("kerb", "punctual", 0.95, 2, 4)},
                                 intervals)[0]
                           .entries;
  EXPECT_EQ(entries[0].estimator, "punctual");
  EXPECT_DOUBLE_EQ(entries[0].event_f1.estimate, 21.0 / 24.0);
  EXPECT_DOUBLE_EQ(entries[1].event_f1.estimate, 0.5);
  EXPECT_TRUE(entries[1].is_not_significantly_worse);  // the best balanced accuracy
}

TEST(Standings, LeaveScenesWithHardlyAnyAirOutOfBalancedAccuracy) {
  const auto with_air = [](const std::string& scene, double accuracy, double air) {
    BenchmarkRow one = row(scene, "a", {accuracy});
    one.air = air;
    return one;
  };
  const Standings::Entry entry =
      standings(
          {with_air("stairs", 0.9, 3.0), with_air("kerb", 0.8, 0.1), with_air("flat", 0.1, 0.09)},
          intervals)[0]
          .entries.at(0);
  EXPECT_DOUBLE_EQ(entry.mean.estimate, 0.85);
  EXPECT_EQ(entry.worst, 0.8);
  EXPECT_EQ(entry.scored, 3U);
  EXPECT_EQ(entry.without_air, 1U);
}

/// A row of one run with 60 s of scored time.
BenchmarkRow scored_row(const std::string& scene, const std::string& split,
                        const std::string& estimator, double accuracy, int switches,
                        const noise::NoiseCell& noise = {}) {
  BenchmarkRow row;
  row.simulator = "mujoco";
  row.robot = "upkie";
  row.sensors = "ideal";
  row.scene = scene;
  row.split = split;
  row.estimator = estimator;
  row.fitted_on = "own";
  row.noise = noise;
  row.balanced_accuracy = {accuracy, {accuracy, accuracy}, {accuracy, accuracy}};
  row.score.scored_us = 60'000'000;
  scoring::EventScore& events = row.score.events;
  events.truth = events.decided = 100;
  events.matched = std::llround(100.0 * accuracy);
  events.extra = switches;
  events.wrong_us = 600'000;
  events.takeoff.add(3000);
  return row;
}

Experiment ranked_experiment(const std::string& estimators, const std::string& table) {
  return experiment_from_yaml(
      YamlDocument::parse("name: unseen\nestimators: [" + estimators +
                              "]\nfit: {scenarios: [scenarios/stairs.yaml]}\n" +
                              "test: {scenarios: [scenarios/stairs.yaml]}\nbenchmark: {" +
                              (table.empty() ? "" : "table: [" + table + "]") + "}\n",
                          "unseen.yaml"));
}

const scoring::BootstrapConfig few_resamples = {.resamples = 200};

TEST(UnseenTable, HasTheMeansOfUnseenScenesOfTheFirstRobot) {
  const noise::NoiseCell noisy{1.0, 5.0};
  std::vector<BenchmarkRow> rows = {
      scored_row("stairs", "test", "robust", 0.1, 900),  // a fitted scene does not count
      scored_row("kerb", "unseen", "robust", 0.75, 3),
      scored_row("squat", "unseen", "robust", 0.85, 6),
      scored_row("kerb", "unseen", "robust", 0.6, 40, noisy),
      scored_row("squat", "unseen", "robust", 0.7, 50, noisy),
      scored_row("kerb", "unseen", "load_filter", 1.0, 0),
      scored_row("squat", "unseen", "load_filter", 1.0, 0),
      scored_row("kerb", "unseen", "load_filter", 1.0, 1, noisy),
      scored_row("squat", "unseen", "load_filter", 0.998, 0, noisy)};
  BenchmarkRow heavy = scored_row("kerb", "unseen", "robust", 0.2, 8);
  heavy.robot = "upkie_heavy";
  rows.push_back(heavy);
  const auto unseen = standings(rows, few_resamples, true);
  const std::string header =
      "| estimator | F1, no added noise | F1, 1 N·m, 5 m/s² | extra switches a minute | long "
      "errors "
      "(s a minute) | takeoff (ms) | landing (ms) | precision of air | balanced accuracy |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  const std::string robust =
      "| `robust` | .800 [.750, .850] | .650 [.600, .700] | 4.5 / 45.0 | 0.60 / 0.60 | +3.0 / +3.0 "
      "| "
      "– / – | – / – | .800 [.750, .850] / .650 [.600, .700] |\n";
  const std::string loads =
      "| `load_filter` | 1 [1, 1] | 1 [1, 1] | 0.0 / 0.5 | 0.60 / 0.60 | +3.0 / +3.0 | – / – | – / "
      "– | "
      "1 [1, 1] / .999 [.998, 1] |\n";
  const std::string all = unseen_markdown(unseen, ranked_experiment("robust, load_filter", ""));
  EXPECT_EQ(all, header + loads + robust);  // the best first
  EXPECT_EQ(unseen_markdown(unseen, ranked_experiment("robust, load_filter", "robust")),
            header + robust);
}

}  // namespace
}  // namespace touchdown::experiments
