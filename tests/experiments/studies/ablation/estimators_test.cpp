#include "experiments/studies/ablation/estimators.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "estimator/bayes/ablation.hpp"
#include "experiments/config/experiment_estimators.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/run_experiment.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "tests/experiments/small_step_scene.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

std::vector<std::string> from_paper_to_robust() {
  std::vector<std::string> names = {"paper"};
  for (const AblationStep& step : steps_from_paper_to_robust()) names.emplace_back(step.name);
  names.emplace_back("robust");
  return names;
}

std::array<std::vector<double>, 2> p_contact_of(const EstimatorEntry& entry, const Model& model,
                                                const RunSignals& run,
                                                const noise::SensorNoise& levels) {
  const auto estimator = entry.make(entry, {.model = &model});
  const NoiseRun noise = noise_run(run, {.seed = 5, .run = 1});
  const scoring::Prediction prediction = predict(*estimator, run, noise, levels);
  return {prediction[0].p_contact, prediction[1].p_contact};
}

TEST(BayesAblation, StepsAreInItsExperimentFromPaperToRobust) {
  const std::vector<std::string> estimators =
      experiment_from_yaml(YamlDocument::load(std::filesystem::path(TOUCHDOWN_SOURCE_DIR) /
                                              "experiments/ablation.yaml"))
          .estimators;
  const std::vector<std::string> steps = from_paper_to_robust();
  EXPECT_NE(std::search(estimators.begin(), estimators.end(), steps.begin(), steps.end()),
            estimators.end());
}

TEST(AblationEstimators, AreNoneOfThoseThatAUserMayChoose) {
  const std::vector<std::string> names = estimator_names();
  EXPECT_EQ(ablation_estimators().size(), 10U);
  for (const EstimatorEntry& entry : ablation_estimators()) {
    EXPECT_EQ(std::count(names.begin(), names.end(), entry.name), 0) << entry.name;
  }
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
  RunOptions options;
  options.out = folder / "run";
  const ExperimentResult result = run_experiment(experiment, options);
  const std::vector<const RunSignals*> runs = scored_runs(result.runs);
  ASSERT_EQ(runs.size(), 1U);
  const auto& models = result.models.at("mujoco");

  EstimatorEntry last = estimator_entry(experiment, steps_from_paper_to_robust().back().name);
  const noise::SensorNoise noise{0.5, 0.5, 3.0};
  const auto robust = p_contact_of(estimator_entry("robust"), models.at("robust"), *runs[0], noise);
  EXPECT_NE(p_contact_of(last, models.at(last.name), *runs[0], noise), robust);
  last.config->transition.row_stochastic = true;
  EXPECT_EQ(p_contact_of(last, models.at(last.name), *runs[0], noise), robust);
}

}  // namespace
}  // namespace touchdown::experiments
