#include "estimator/bayes/ablation.hpp"

#include <algorithm>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/table.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "tests/experiments/studies/study_test.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

struct Ablation : ::testing::Test {
  Experiment experiment(const std::string& more) const {
    const std::string scene = folder.write("small_step.yaml", small_step_scene).string();
    return experiment_from_yaml(YamlDocument::parse(
        "name: steps\nfit: {scenarios: [" + scene + "], runs: 2, perturbed: true}\n" +
            "test: {scenarios: [" + scene +
            "], runs: 3}\nrecordings: none\nvideo: {enabled: false}\n"
            "noise: {torque: [0, 1], accelerometer: [0, 5]}\n"
            "highlights: [{torque: 0, accelerometer: 0}, {torque: 1, accelerometer: 5}]\n" +
            more,
        "steps.yaml"));
  }

  ScratchFolder folder;
};

TEST_F(Ablation, ComparesEachStepWithTheOneBeforeIt) {
  RunOptions options;
  options.out = folder / "run";
  const ExperimentResult result = run_experiment(
      experiment("estimators: [load_filter, paper, paper_low_pass, paper_switch, robust]\n"
                 "benchmark: {refits: 1}\nablation: {from: paper, to: robust}\n"),
      options);
  const Table table = result.directory.read_table("ablation.csv");
  const Table standings = result.directory.read_table("benchmark_standings.csv");
  // The benchmark's standings are the same means, with the same intervals.
  std::map<std::string, std::string> mean;
  for (const TableRow& row : standings.all()) {
    mean[row.text("torque_noise_nm") + row.text("estimator")] =
        row.text("mean_balanced_accuracy") + row.text("mean_balanced_accuracy_low");
  }
  const std::vector<std::string> steps = {"paper", "paper_low_pass", "paper_switch", "robust"};
  ASSERT_EQ(table.rows.size(), 2 * steps.size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const TableRow row(table, i);
    const auto value = [&](const char* name) { return row.text(name); };
    EXPECT_EQ(value("estimator"), steps[i % 4]);
    EXPECT_EQ(value("balanced_accuracy") + value("balanced_accuracy_low"),
              mean.at(value("torque_noise_nm") + value("estimator")));
    EXPECT_EQ(value("runs"), "6");  // of both engines
    if (i % 4 == 0) {
      EXPECT_EQ(value("before") + value("gain"), "nan");
      continue;
    }
    EXPECT_EQ(value("before"), steps[i % 4 - 1]);
    const double before = TableRow(table, i - 1).number("balanced_accuracy");
    EXPECT_NEAR(std::stod(value("gain")), std::stod(value("balanced_accuracy")) - before, 2e-6);
    EXPECT_LE(std::stod(value("gain_low")), std::stod(value("gain_high")));
  }
  EXPECT_THAT(result.studies.back(), HasSubstr("paper_low_pass"));
  EXPECT_THAT(own_files(folder / "run"), Contains(std::filesystem::path("tables/ablation.csv")));
  ASSERT_FALSE(result.figures.empty());
  EXPECT_EQ(result.figures.back().name, "ablation");
  EXPECT_EQ(result.figures.back().rows.groups.size(), 3U);  // the first step has no gain
}

std::vector<std::string> from_paper_to_robust() {
  std::vector<std::string> names = {"paper"};
  for (const AblationStep& step : steps_from_paper_to_robust()) names.emplace_back(step.name);
  names.emplace_back("robust");
  return names;
}

std::array<std::vector<double>, 2> p_contact_of(const EstimatorEntry& entry, const Model& model,
                                                const RunSignals& run,
                                                const noise::SensorNoise& levels) {
  const auto estimator = entry.make({.model = &model});
  const NoiseRun noise = noise_run(run, {.seed = 5, .run = 1});
  const scoring::Prediction prediction = predict(*estimator, run, noise, levels);
  return {prediction[0].p_contact, prediction[1].p_contact};
}

TEST(BayesAblation, StepsAreInItsExperimentFromPaperToRobust) {
  const std::vector<std::string> estimators =
      experiment_from_yaml(
          completed(YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/experiments/ablation.yaml"),
                    YamlKind::experiment))
          .estimators;
  const std::vector<std::string> steps = from_paper_to_robust();
  EXPECT_NE(std::search(estimators.begin(), estimators.end(), steps.begin(), steps.end()),
            estimators.end());
}

TEST(BayesAblation, EndsInRobustToTheBitOnASimulatedRun) {
  const ScratchFolder folder;
  const std::string scene = folder.write("small_step.yaml", small_step_scene).string();
  Experiment experiment;
  experiment.name = "ablation";
  experiment.simulators = {"mujoco"};
  experiment.estimators = from_paper_to_robust();
  experiment.external_estimators = ablation_estimators();
  experiment.fit = {.scenarios = {scene}, .runs = 2};
  experiment.test = {.scenarios = {scene}, .runs = 1};
  experiment.highlights = {{}};
  experiment.video.enabled = false;
  const ExperimentResult result = run_in(folder, experiment);
  const FinishedRun* const run = test_run(result.runs, "mujoco", 0);
  ASSERT_FALSE(run == nullptr || run->failed());
  const RunSignals signals = signals_of(*run, experiment);
  const auto& models = result.models.at("mujoco");

  EstimatorEntry last = estimator_entry(experiment, steps_from_paper_to_robust().back().name);
  const noise::SensorNoise noise{0.5, 0.5, 3.0};
  const auto robust = p_contact_of(estimator_entry("robust"), models.at("robust"), signals, noise);
  EXPECT_NE(p_contact_of(last, models.at(last.name), signals, noise), robust);
  last.configuration["transition.row_stochastic"] = "true";
  EXPECT_EQ(p_contact_of(last, models.at(last.name), signals, noise), robust);
}

}  // namespace
}  // namespace touchdown::experiments
