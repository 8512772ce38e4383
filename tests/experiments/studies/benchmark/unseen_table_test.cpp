#include "experiments/studies/benchmark/unseen_table.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/yaml.hpp"
#include "experiments/studies/experiment_file.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;

/// A row of one run with 60 s of scored time.
BenchmarkRow row(const std::string& scene, const std::string& split, const std::string& estimator,
                 double accuracy, int switches, const noise::NoiseCell& noise = {}) {
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
  row.extended.extra_switches = switches;
  return row;
}

Experiment experiment_with(const std::string& estimators, const std::string& table) {
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
      row("stairs", "test", "robust", 0.1, 900),  // a fitted scene does not count
      row("kerb", "unseen", "robust", 0.75, 3),
      row("squat", "unseen", "robust", 0.85, 6),
      row("kerb", "unseen", "robust", 0.6, 40, noisy),
      row("squat", "unseen", "robust", 0.7, 50, noisy),
      row("kerb", "unseen", "hmm", 1.0, 0),
      row("squat", "unseen", "hmm", 1.0, 0),
      row("kerb", "unseen", "hmm", 1.0, 1, noisy),
      row("squat", "unseen", "hmm", 0.998, 0, noisy),
      row("kerb", "unseen", "boosted_channels", 1.0, 0),
      row("squat", "unseen", "boosted_channels", 1.0, 0)};
  BenchmarkRow heavy = row("kerb", "unseen", "robust", 0.2, 8);
  heavy.robot = "upkie_heavy";
  rows.push_back(heavy);
  const auto unseen = standings_of_unseen(rows, few_resamples);
  const std::string header =
      "| estimator | no added noise | 1 N·m, 5 m/s² | extra switches a minute |\n"
      "|---|---|---|---|\n";
  const std::string robust = "| `robust` | .800 [.750, .850] | .650 [.600, .700] | 4.5 / 45.0 |\n";
  const std::string hmm = "| `hmm` | 1 [1, 1] | .999 [.998, 1] | 0.0 / 0.5 |\n";
  const std::string all = unseen_markdown(unseen, experiment_with("robust, hmm", ""));
  EXPECT_EQ(all, header + hmm + robust);  // the best first; a bound is not ranked
  EXPECT_EQ(unseen_markdown(unseen, experiment_with("robust, hmm", "robust")), header + robust);
}

TEST(UnseenTable, HasADashForAnEstimatorThatWasNotScored) {
  const auto unseen =
      standings_of_unseen({row("kerb", "unseen", "robust", 0.75, 3)}, few_resamples);
  EXPECT_THAT(unseen_markdown(unseen, experiment_with("robust, phase", "phase")),
              HasSubstr("| `phase` | – | – |\n"));
}

TEST(UnseenTable, IsEmptyWithoutUnseenScenes) {
  const auto unseen = standings_of_unseen({row("stairs", "test", "robust", 0.9, 3)}, few_resamples);
  EXPECT_TRUE(unseen.empty());
  EXPECT_EQ(unseen_markdown(unseen, experiment_with("robust", "")), "");
}

}  // namespace
}  // namespace touchdown::experiments
