#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/config/experiment.hpp"
#include "experiments/config/experiment_yaml.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Experiment tuning_of(const std::string& tuning) {
  return experiment_from_yaml(
      YamlDocument::parse("name: study\n"
                          "test: {scenarios: [scenarios/stairs.yaml]}\n"
                          "fit: {scenarios: [scenarios/stairs.yaml], runs: 4, perturbed: true, " +
                              tuning + "}\n",
                          "study.yaml"));
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

}  // namespace
}  // namespace touchdown::experiments
