#include "experiments/evaluation/tune.hpp"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/error.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/logs/estimator.hpp"
#include "logs/model_file.hpp"
#include "tests/experiments/synthetic_runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::vector<RunSignals> fitted_runs(int count) {
  std::vector<RunSignals> runs;
  for (int i = 0; i < count; ++i) runs.push_back(synthetic_run(first_fit_run + i, 2000));
  return runs;
}

Experiment tuned_experiment(const std::vector<std::string>& estimators, int trials) {
  Experiment experiment = synthetic_experiment(estimators);
  experiment.fit = {.scenarios = {"synthetic"}, .runs = 4, .perturbed = true};
  experiment.tuning = TuningConfig{.trials = trials, .folds = 2, .fixed = {}};
  return experiment;
}

/// The load filter with a default threshold above every belief.
EstimatorEntry rigged() {
  EstimatorEntry entry = estimator_entry("load_filter");
  entry.name = "rigged";
  entry.making.by_step = [](const EstimatorEntry& renamed, const EstimatorSetup& setup) {
    EstimatorEntry own = renamed;
    own.name = "load_filter";
    return make_of_model(own, setup);
  };
  for (Hyperparameter& hyperparameter : entry.hyperparameters) {
    if (hyperparameter.name != "return_above") continue;
    hyperparameter = between("return_above", 0.99999, 0.7, 0.99999);
  }
  return entry;
}

const Trial& chosen_of(const std::vector<Trial>& trials) {
  return *std::find_if(trials.begin(), trials.end(), [](const Trial& t) { return t.is_chosen; });
}

TEST(Tune, CorrectsABadDefault) {
  const std::vector<RunSignals> runs = fitted_runs(4);
  Experiment experiment = tuned_experiment({"rigged"}, 16);
  experiment.external_estimators = {rigged()};
  const std::vector<Trial> trials = tune(experiment, "", pointers_to(runs), {});
  ASSERT_EQ(trials.size(), 16U);
  EXPECT_EQ(trials.front().hyperparameters.at("return_above"), 0.99999);
  EXPECT_EQ(trials.front().score, 0.0);  // it decides no event
  const Trial& best = chosen_of(trials);
  EXPECT_GT(best.score, 0.9);
  EXPECT_LT(best.hyperparameters.at("return_above"), 0.999);
  // It needs no fit, but uses the chosen values.
  const FittedModels models = fit_models(experiment, pointers_to(runs), {}, chosen_in(trials));
  const RunSignals test = synthetic_run(0);
  const Condition condition{"mujoco", "mujoco", "rigged"};
  EXPECT_EQ(entry_of(experiment, condition, models).chosen("return_above"),
            best.hyperparameters.at("return_above"));
  scoring::Classification with, without;
  const std::vector<noise::NoiseCell> cells = {{}};
  const NoiseRun noise = noise_run(test, {.seed = 1, .run = 0});
  const FittedModels none;
  for (const auto& [found, counts] : {std::pair(&models, &with), std::pair(&none, &without)}) {
    for (const scoring::Classification& segment : sweep_run(
             std::vector{condition}, cells, test, noise, *found, experiment, [] { return true; })) {
      *counts += segment;
    }
  }
  EXPECT_GT(with.balanced_accuracy(), 0.9);
  EXPECT_LT(without.balanced_accuracy(), 0.6);
}

TEST(Tune, GivesEveryTunableEstimatorTheSameNumberOfTrials) {
  const Experiment experiment =
      tuned_experiment({"robust", "paper", "load_filter", "free_fall", "oracle"}, 3);
  std::map<std::string, int> count, chosen;
  for (const Trial& trial : tune(experiment, "", pointers_to(fitted_runs(4)), {})) {
    EXPECT_EQ(trial.number, count[trial.estimator]++);
    chosen[trial.estimator] += trial.is_chosen ? 1 : 0;
    EXPECT_GT(trial.score, 0.3) << trial.estimator;
    EXPECT_LE(trial.score, 1.0) << trial.estimator;
  }
  EXPECT_EQ(count, (std::map<std::string, int>{
                       {"free_fall", 3}, {"load_filter", 3}, {"paper", 3}, {"robust", 3}}));
  for (const auto& [estimator, times] : chosen) EXPECT_EQ(times, 1) << estimator;
}

TEST(Tune, ChoosesIndependentlyOfTheNumberOfThreads) {
  const std::vector<RunSignals> runs = fitted_runs(4);
  const Experiment experiment = tuned_experiment({"robust", "load_filter"}, 4);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<std::pair<double, bool>> all;
    for (const Trial& trial : tune(experiment, "", pointers_to(runs), {})) {
      all.emplace_back(trial.score, trial.is_chosen);
    }
    return all;
  };
  EXPECT_EQ(with(1), with(4));
}

/// Without noise a fast filter is best, with much noise a slow one.
TEST(Tune, UsesTheNoiseOfItsSection) {
  const std::vector<RunSignals> runs = fitted_runs(4);
  Experiment experiment = tuned_experiment({"free_fall"}, 12);
  const auto trials_with = [&](const std::vector<noise::NoiseCell>& noise) {
    experiment.tuning->noise = noise;
    return tune(experiment, "", pointers_to(runs), {});
  };
  const std::vector<Trial> none = trials_with({{}});
  const std::vector<Trial> much = trials_with({{0.0, 20.0}});
  const std::vector<Trial> both = trials_with({{}, {0.0, 20.0}});
  for (std::size_t i = 0; i < none.size(); ++i) {
    EXPECT_LT(much[i].score, none[i].score) << i;
    EXPECT_GE(both[i].score, much[i].score) << i;  // of pooled events
    EXPECT_LE(both[i].score, none[i].score) << i;
  }
  EXPECT_GT(chosen_of(much).hyperparameters.at("low_pass"),
            chosen_of(none).hyperparameters.at("low_pass"));
}

TEST(Tune, ReusesSavedTrials) {
  const ScratchFolder folder;
  std::vector<RunSignals> runs = fitted_runs(4);
  runs[1].info.scenario = "other scene";
  const Experiment experiment = tuned_experiment({"robust", "free_fall"}, 3);
  const auto scores = [&](const Store& saved) {
    std::vector<double> all;
    for (const Trial& trial : tune(experiment, "", pointers_to(runs), {}, saved)) {
      all.push_back(trial.score);
    }
    return all;
  };
  const std::vector<double> tried = scores({});
  EXPECT_EQ(tried, scores({folder.path(), "key"}));
  // All signals are flight now. Saved trials are used all the same, but not with another key.
  for (RunSignals& run : runs) {
    for (Signals& step : run.signals) step.vertical_acceleration = -9.81;
  }
  EXPECT_EQ(tried, scores({folder.path(), "key"}));
  EXPECT_NE(tried, scores({folder.path(), "another key"}));
}

TEST(Tune, ChoosesTheFirstOfEqualTrials) {
  // Nothing moves: every threshold gives contact at all steps.
  std::vector<RunSignals> runs = fitted_runs(2);
  for (RunSignals& run : runs) {
    for (Signals& step : run.signals) step.vertical_acceleration = 0.0;
    for (auto& wheel : run.contact) std::fill(wheel.begin(), wheel.end(), std::uint8_t{1});
  }
  const std::vector<Trial> trials =
      tune(tuned_experiment({"free_fall"}, 5), "", pointers_to(runs), {});
  for (const Trial& trial : trials) EXPECT_EQ(trial.score, 0.0);  // no event to find
  EXPECT_EQ(chosen_of(trials).number, 0);
}

TEST(Tune, NamesTheFoldWithTooLittleData) {
  std::vector<RunSignals> runs = fitted_runs(2);
  for (auto& wheel : runs[1].contact) std::fill(wheel.begin(), wheel.end(), std::uint8_t{1});
  EXPECT_THAT(
      [&] { tune(tuned_experiment({"robust"}, 2), "", pointers_to(runs), {}); },
      ThrowsMessage<InputError>(HasSubstr("fit.tuning: robust on mujoco, without fold 1 of 2: ")));
  EXPECT_THROW(tune(tuned_experiment({"robust"}, 2), "", pointers_to(runs), [] { return false; }),
               Stopped);
}

/// Robots read the values from the metadata.
TEST(Tune, StoresChosenValuesInTheMetadata) {
  const std::vector<RunSignals> runs = fitted_runs(2);
  const Experiment experiment = tuned_experiment({"robust", "paper"}, 1);
  const auto metadata = [&](const std::string& estimator,
                            const HyperparameterValues& hyperparameters) {
    const TunedHyperparameters chosen = {{"mujoco", {{estimator, hyperparameters}}}};
    return fit_models(experiment, pointers_to(runs), {}, chosen)
        .at("mujoco")
        .at(estimator)
        .metadata;
  };
  const auto usual = fit_models(experiment, pointers_to(runs)).at("mujoco");
  const auto tuned = metadata("robust", {{"threshold", 0.25}});
  EXPECT_EQ(tuned->configuration.at("threshold"), "0.25");
  EXPECT_EQ(usual.at("robust").metadata->configuration.at("threshold"), "0.8");
  EXPECT_EQ(metadata("paper", {{"transition.switch.offset", 3.5}})
                ->configuration.at("transition.switch.offset"),
            "3.5");
  // Hyperparameters of the fit alone are in the model, not in the metadata.
  const auto wide = metadata("robust", {{"threshold", 0.125}, {"bandwidth_floor", 0.3}});
  EXPECT_EQ(wide->configuration.at("threshold"), "0.125");
  EXPECT_FALSE(wide->configuration.contains("bandwidth_floor"));
}

TEST(Tune, SetsTheHyperparametersOfLogEstimators) {
  const ScratchFolder folder;
  const TunedHyperparameters chosen = {{"mujoco", {{"robust", {{"threshold", 0.25}}}}}};
  const FittedModels models =
      fit_models(tuned_experiment({"robust"}, 1), pointers_to(fitted_runs(2)), {}, chosen);
  const std::filesystem::path file = folder / "model.npz";
  logs::save_model(models.at("mujoco").at("robust"), file);
  EXPECT_EQ(log_estimator({.model = file}).entry.chosen("threshold"), 0.25);
  EXPECT_EQ(estimator_entry("robust").chosen("threshold"), 0.8);
}

TEST(Tune, LeavesFixedEstimatorsAlone) {
  const std::vector<RunSignals> runs = fitted_runs(4);
  Experiment experiment = tuned_experiment({"free_fall", "load_filter", "robust"}, 2);
  experiment.tuning->fixed = {"load_filter"};
  std::set<std::string> tried;
  for (const Trial& trial : tune(experiment, "", pointers_to(runs), {})) {
    tried.insert(trial.estimator);
  }
  EXPECT_EQ(tried, (std::set<std::string>{"free_fall", "robust"}));
}

}  // namespace
}  // namespace touchdown::experiments
