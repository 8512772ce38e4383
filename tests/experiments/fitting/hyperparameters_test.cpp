#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "estimator/numerics/number_text.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/results/captions.hpp"
#include "tests/experiments/synthetic_runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Experiment with(const std::string& more) {
  return experiment_from_yaml(YamlDocument::parse(
      "name: study\nsimulators: [mujoco]\nestimators: [robust, free_fall]\nfit: {scenarios: "
      "[scenarios/stairs.yaml]}\ntest: {scenarios: [scenarios/stairs.yaml]}\n" +
          more,
      "study.yaml"));
}

const char* const given =
    "hyperparameters: {robust: {threshold: 0.375}, free_fall: {half_way: -3}}\n";

TEST(GivenHyperparameters, AreUsedByFitsAndEstimators) {
  Experiment experiment = synthetic_experiment({"robust", "free_fall"});
  experiment.hyperparameters = with(given).hyperparameters;
  const std::vector<RunSignals> runs = {synthetic_run(first_fit_run)};
  const FittedModels models = fit_models(experiment, pointers_to(runs));
  const FittedModel& robust = models.at("mujoco").at("robust");
  EXPECT_EQ(robust.metadata->configuration.at("threshold"), "0.375");
  const auto entry_for = [&](const char* estimator) {
    return entry_of(experiment, {"mujoco", "mujoco", estimator}, models);
  };
  EXPECT_EQ(entry_for("robust").configuration.at("threshold"), "0.375");
  EXPECT_EQ(entry_for("free_fall").chosen("half_way"), -3.0);
}

TEST(GivenHyperparameters, SetTheMembersThatTheyAreNamedAfter) {
  const EstimatorEntry robust =
      with_hyperparameters(estimator_entry("robust"), {{"threshold", 0.3},
                                                       {"transition.switch.offset", 2.7},
                                                       {"transition.switch.slope", 1.0 / 3.0},
                                                       {"bandwidth_floor", 0.07}});
  EXPECT_EQ(robust.configuration.at("threshold"), "0.3");
  EXPECT_EQ(robust.configuration.at("transition.switch.offset"), "2.7");
  EXPECT_EQ(robust.configuration.at("transition.switch.slope"), touchdown::text_of(1.0 / 3.0));
  EXPECT_EQ(robust.fitting.torques->fit.bandwidth_floor, (TorqueBandwidth{0.07, 0.07}));
}

TEST(GivenHyperparameters, YieldToChosenOnes) {
  const Experiment experiment = with(given);
  const TunedHyperparameters all =
      or_given({{"mujoco", {{"robust", {{"threshold", 0.3}}}}}}, experiment);
  EXPECT_EQ(all.at("mujoco").at("robust").at("threshold"), 0.3);
  EXPECT_EQ(all.at("mujoco").at("free_fall").at("half_way"), -3.0);
}

TEST(GivenHyperparameters, AreWrittenReadAndReported) {
  EXPECT_THAT(to_yaml(with("")), Not(HasSubstr("hyperparameters")));
  const std::string text = to_yaml(with(given));
  EXPECT_EQ(text, to_yaml(experiment_from_yaml(YamlDocument::parse(text, "again.yaml"))));
  EXPECT_THAT(tuning_text(with(given)),
              AllOf(HasSubstr("threshold of Bayes filter (robust): 0.375"),
                    HasSubstr("half_way of Free fall: -3")));
}

/// Both engines, with hyperparameters from a file with this content.
Experiment with_file(const ScratchFolder& folder, const std::string& content,
                     const std::string& more = "") {
  const std::string file = folder.write("chosen.yaml", content).string();
  return experiment_from_yaml(YamlDocument::parse(
      "name: study\nestimators: [robust, free_fall]\nfit: {scenarios: [scenarios/stairs.yaml]}\n"
      "test: {scenarios: [scenarios/stairs.yaml]}\nhyperparameters: {tuned: " +
          file + more + "}\n",
      "study.yaml"));
}

TEST(HyperparameterFile, GivesEachEngineItsOwnValuesBeforeThoseOfAll) {
  const ScratchFolder folder;
  const Experiment experiment = with_file(
      folder,
      "manifest: {anything: 1}\nmujoco: {robust: {threshold: 0.375}, paper: {threshold: 0.3}}\n"
      "bullet: {robust: {threshold: 0.25}}\n",
      ", robust: {threshold: 0.4, bandwidth_floor: 0.05}, free_fall: {half_way: -3}");
  const TunedHyperparameters all = or_given({}, experiment);
  EXPECT_EQ(all.at("mujoco").at("robust"), (HyperparameterValues{{"threshold", 0.375}}));
  EXPECT_EQ(all.at("bullet").at("robust"), (HyperparameterValues{{"threshold", 0.25}}));
  EXPECT_EQ(all.at("bullet").at("free_fall").at("half_way"), -3.0);
  EXPECT_FALSE(all.at("mujoco").contains("paper")) << "not among the estimators";
  EXPECT_EQ(or_given({{"mujoco", {{"robust", {{"threshold", 0.3}}}}}}, experiment)
                .at("mujoco")
                .at("robust")
                .at("threshold"),
            0.3);
  const std::string text = to_yaml(experiment);
  EXPECT_THAT(text, Not(HasSubstr("chosen.yaml"))) << "a run directory needs no other file";
  EXPECT_EQ(text, to_yaml(experiment_from_yaml(YamlDocument::parse(text, "again.yaml"))));
  EXPECT_THAT(tuning_text(experiment), HasSubstr("by engine"));
}

}  // namespace
}  // namespace touchdown::experiments
