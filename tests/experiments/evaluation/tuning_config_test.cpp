#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/config/experiment_yaml.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

/// The section `fit` is on the third line, its tuning on the fifth.
Experiment tuning_of(const std::string& tuning,
                     const std::string& runs = "runs: 4, perturbed: true") {
  return experiment_from_yaml(
      YamlDocument::parse("name: study\n"
                          "test: {scenarios: [scenarios/stairs.yaml]}\n"
                          "fit:\n  {scenarios: [scenarios/stairs.yaml], " +
                              runs + ",\n   " + tuning + "}\n",
                          "study.yaml"));
}

auto complains(const std::string& place, const std::string& what) {
  return ThrowsMessage<InputError>(AllOf(StartsWith("study.yaml:" + place), HasSubstr(what)));
}

TEST(TuningConfig, HasNoTuningByDefault) {
  const Experiment experiment = tuning_of("seed: 3");
  EXPECT_FALSE(experiment.tuning.has_value());
  EXPECT_THAT(to_yaml(experiment), Not(HasSubstr("tuning")));
}

TEST(TuningConfig, ReadsBackUnchanged) {
  const Experiment experiment = tuning_of(
      "tuning: {trials: 7, folds: 3, noise: [{torque: 0, accelerometer: 0}, {torque: 1, "
      "accelerometer: 5}]}");
  ASSERT_TRUE(experiment.tuning.has_value());
  EXPECT_EQ(experiment.tuning->trials, 7);
  EXPECT_EQ(experiment.tuning->folds, 3);
  EXPECT_EQ(experiment.tuning->noise, (std::vector<noise::NoiseCell>{{0.0, 0.0}, {1.0, 5.0}}));
  EXPECT_EQ(tuning_of("tuning: {trials: 7}").tuning->noise, std::vector<noise::NoiseCell>(1));
  const std::string text = to_yaml(experiment);
  EXPECT_THAT(text, HasSubstr("trials: 7"));
  EXPECT_EQ(text, to_yaml(experiment_from_yaml(YamlDocument::parse(text, "again.yaml"))));
}

TEST(TuningConfig, ReportsThePositionAndSuggestsTheNearestKey) {
  EXPECT_THAT([] { tuning_of("tunning: {trials: 7}"); },
              complains("5:4: fit.tunning: ", "did you mean 'tuning'?"));
  EXPECT_THAT([] { tuning_of("tuning: {trials: 7, fold: 2}"); },
              complains("5:24: fit.tuning.fold: ", "did you mean 'folds'?"));
  EXPECT_THAT([] { tuning_of("tuning: {folds: 2}"); },
              complains("5:12: fit.tuning.trials: ", "missing"));
  EXPECT_THAT([] { tuning_of("tuning: {trials: 0}"); },
              complains("5:21: fit.tuning.trials: ", "expected a number from 1 to 10000"));
  EXPECT_THAT([] { tuning_of("tuning: {trials: 7, folds: 1}"); },
              complains("5:31: fit.tuning.folds: ", "expected a number from 2 to 1000"));
  EXPECT_THAT([] { tuning_of("tuning: {trials: 7, noise: []}"); },
              complains("5:31: fit.tuning.noise: ", "at least one noise setting"));
  EXPECT_THAT([] { tuning_of("tuning: {trials: 7, noise: [{torque: 1}]}"); },
              complains("5:32: fit.tuning.noise.0.accelerometer: ", "is missing"));
  EXPECT_THAT([] { tuning_of("tuning: 7"); },
              complains("5:12: fit.tuning: ", "expected a mapping"));
}

TEST(TuningConfig, HasNoMoreFoldsThanDifferentRuns) {
  EXPECT_NO_THROW(tuning_of("tuning: {trials: 7, folds: 4}"));
  EXPECT_THAT([] { tuning_of("tuning: {trials: 7, folds: 5}"); },
              complains("5:31: fit.tuning.folds: ", "number of different fitted runs, 4"));
  // A scene without perturbations counts as one run.
  EXPECT_THAT([] { tuning_of("tuning: {trials: 7}", "runs: 4, perturbed: false"); },
              complains("5:12: fit.tuning.folds: ", "number of different fitted runs, 1"));
}

}  // namespace
}  // namespace touchdown::experiments
