#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "core/table.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/evaluation/tuning_table.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_experiment.hpp"
#include "tests/experiments/small_step_scene.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// An experiment on one step, with one estimator that is fitted and one that is not.
Experiment tuned_study(const ScratchFolder& folder, const std::string& tuning,
                       const std::string& test = "") {
  const std::string step = folder.write("small_step.yaml", small_step_scene).string();
  YamlDocument document = YamlDocument::parse(
      "name: small\nsimulators: [mujoco]\nestimators: [paper, load_filter]\nseed: 2\n"
      "fit: {scenarios: [" +
          step + "], runs: 2, perturbed: true, seed: 11" + tuning +
          "}\n"
          "test: {scenarios: [" +
          step +
          "], runs: 2}\nrecordings: none\nvideo: {enabled: false}\n"
          "benchmark: {}\n",
      "small.yaml");
  if (!test.empty()) document.override_value(test);
  return experiment_from_yaml(document);
}

class TunedExperiment : public ::testing::Test {
 protected:
  ExperimentResult run(const std::string& name, const Experiment& experiment) const {
    RunOptions options;
    options.out = folder_ / name;
    return run_experiment(experiment, options);
  }
  std::string text(const std::string& name, const std::string& file) const {
    return read_file(folder_ / name / file);
  }
  ScratchFolder folder_;
};

TEST_F(TunedExperiment, ChoosesIndependentlyOfTestRuns) {
  const std::string tuning = ", tuning: {trials: 6}";
  const std::string stand =
      folder_.write("stand.yaml", "name: stand\nend: {duration: 1.0}\nperturbation: {yaw: 0.05}\n")
          .string();
  const ExperimentResult result = run("one", tuned_study(folder_, tuning));
  run("other_seed", tuned_study(folder_, tuning, "seed=3"));
  run("other_scenes", tuned_study(folder_, tuning, "test.scenarios=[" + stand + "]"));
  const std::string chosen = text("one", "tables/tuning.csv");
  EXPECT_EQ(chosen, text("other_seed", "tables/tuning.csv"));
  EXPECT_EQ(chosen, text("other_scenes", "tables/tuning.csv"));
  EXPECT_EQ(text("one", "models/mujoco_paper.npz"), text("other_seed", "models/mujoco_paper.npz"));
  // The test runs differ, so the scores do.
  EXPECT_NE(text("one", "tables/benchmark.csv"), text("other_seed", "tables/benchmark.csv"));

  // The table gives the chosen values, which films use.
  const TextTable table = from_csv(chosen);
  EXPECT_EQ(table.rows.size(), 2U * 6);
  const TunedHyperparameters read = read_chosen(folder_ / "one");
  for (const char* estimator : {"paper", "load_filter"}) {
    EXPECT_EQ(read.at("mujoco").at(estimator),
              result.models.at("mujoco").at(estimator).hyperparameters);
    EXPECT_FALSE(read.at("mujoco").at(estimator).empty());
  }
  EXPECT_THAT(result.studies, Contains(HasSubstr("the best of 6 trials")));
  ASSERT_FALSE(result.figures.empty());
  EXPECT_EQ(result.figures.front().name, "tuning");
  EXPECT_EQ(result.figures.front().rows.groups.size(), 2U);
  EXPECT_THAT(result.figures.front().alt,
              AllOf(StartsWith("F1 of the chosen trials."), HasSubstr(" for Load filter")));
  EXPECT_THAT(own_files(folder_ / "one"), Contains(std::filesystem::path("tables/tuning.csv")));
}

TEST_F(TunedExperiment, WithDefaultsAloneEqualsNoTuning) {
  run("none", tuned_study(folder_, ""));
  run("defaults", tuned_study(folder_, ", tuning: {trials: 1}"));
  for (const char* file : {"tables/benchmark.csv", "tables/views.csv", "tables/success.csv",
                           "tables/latency.csv", "models/mujoco_paper.npz"}) {
    EXPECT_EQ(text("none", file), text("defaults", file)) << file;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none/tables/tuning.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "defaults/tables/tuning.csv"));
}

TEST_F(TunedExperiment, SharesChoicesWithOtherSensorsUnlessTunedEverywhere) {
  const std::string harsh =
      "benchmark.sensors=[" + std::string(TOUCHDOWN_SOURCE_DIR) + "/noise/profiles/harsh.yaml]";
  const auto fits_in = [&](const std::string& name) {
    const TextTable table = from_csv(text(name, "tables/tuning.csv"));
    std::set<std::string> fits;
    for (const std::vector<std::string>& row : table.rows) fits.insert(cell(table, row, "fit"));
    return fits.size();
  };
  const ExperimentResult once = run("once", tuned_study(folder_, ", tuning: {trials: 6}", harsh));
  EXPECT_EQ(fits_in("once"), 1U);
  ASSERT_EQ(once.models.size(), 2U);
  const HyperparameterValues& own = once.models.at("mujoco").at("load_filter").hyperparameters;
  EXPECT_FALSE(own.empty());
  for (const auto& [fit, models] : once.models) {
    EXPECT_EQ(models.at("load_filter").hyperparameters, own) << fit;
    EXPECT_TRUE(models.contains("paper")) << fit;
  }
  run("everywhere", tuned_study(folder_, ", tuning: {trials: 6, everywhere: true}", harsh));
  EXPECT_EQ(fits_in("everywhere"), 2U);
}

/// Another user repeats a tuned experiment without its trials.
TEST_F(TunedExperiment, WritesItsChoicesAsAFileThatReplacesTheTuning) {
  const ExperimentResult tuned = run("tuned", tuned_study(folder_, ", tuning: {trials: 6}"));
  const std::string file = (folder_ / "tuned/tables/hyperparameters.yaml").string();
  EXPECT_THAT(read_file(file), HasSubstr("manifest: {experiment: small, seed: 11, trials: 6,"));
  EXPECT_THAT(own_files(folder_ / "tuned"),
              Contains(std::filesystem::path("tables/hyperparameters.yaml")));
  const Experiment given = tuned_study(folder_, "", "hyperparameters={tuned: " + file + "}");
  EXPECT_EQ(to_yaml(given),
            to_yaml(experiment_from_yaml(YamlDocument::parse(to_yaml(given), "config.yaml"))));
  const ExperimentResult repeated = run("given", given);
  for (const char* estimator : {"paper", "load_filter"}) {
    EXPECT_EQ(repeated.models.at("mujoco").at(estimator).hyperparameters,
              tuned.models.at("mujoco").at(estimator).hyperparameters);
  }
  for (const char* table : {"tables/benchmark.csv", "tables/success.csv", "tables/latency.csv",
                            "models/mujoco_paper.npz"}) {
    EXPECT_EQ(text("given", table), text("tuned", table)) << table;
  }
}

TEST_F(TunedExperiment, MakesAnotherRequestThanWithoutTrials) {
  EXPECT_NE(request_of(tuned_study(folder_, "")).id,
            request_of(tuned_study(folder_, ", tuning: {trials: 2}")).id);
  EXPECT_NE(request_of(tuned_study(folder_, ", tuning: {trials: 3}")).id,
            request_of(tuned_study(folder_, ", tuning: {trials: 2}")).id);
}

}  // namespace
}  // namespace touchdown::experiments
