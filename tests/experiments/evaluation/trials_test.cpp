#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/evaluation/tune.hpp"
#include "experiments/fitting/fitting.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

TEST(Trials, BeginWithTheDefaultsAndStayInTheirRanges) {
  for (const EstimatorEntry& entry : all_estimator_entries()) {
    const std::vector<HyperparameterValues> all = trial_hyperparameters(entry, 1, 200);
    ASSERT_EQ(all.size(), entry.hyperparameters.empty() ? 0U : 200U) << entry.name;
    for (const Hyperparameter& hyperparameter : entry.hyperparameters) {
      EXPECT_EQ(all.front().at(hyperparameter.name), hyperparameter.value) << entry.name;
      EXPECT_LT(hyperparameter.lowest, hyperparameter.value)
          << entry.name << " " << hyperparameter.name;
      EXPECT_GT(hyperparameter.highest, hyperparameter.value)
          << entry.name << " " << hyperparameter.name;
      double least = hyperparameter.highest;
      double most = hyperparameter.lowest;
      for (const HyperparameterValues& hyperparameters : all) {
        const double value = hyperparameters.at(hyperparameter.name);
        // Three digits of a number may lie beyond the end by half of the last.
        EXPECT_GE(value, hyperparameter.lowest - 0.005 * std::abs(hyperparameter.lowest))
            << hyperparameter.name;
        EXPECT_LE(value, hyperparameter.highest + 0.005 * std::abs(hyperparameter.highest))
            << hyperparameter.name;
        if (hyperparameter.scale == Hyperparameter::Scale::whole) {
          EXPECT_EQ(value, std::round(value));
        }
        least = std::min(least, value);
        most = std::max(most, value);
      }
      // 200 draws come close to both ends.
      const bool by_ratio = hyperparameter.scale == Hyperparameter::Scale::by_ratio;
      const auto on_scale = [&](double x) { return by_ratio ? std::log(x) : x; };
      const double span = on_scale(hyperparameter.highest) - on_scale(hyperparameter.lowest);
      EXPECT_LT(on_scale(least), on_scale(hyperparameter.lowest) + 0.1 * span)
          << entry.name << hyperparameter.name;
      EXPECT_GT(on_scale(most), on_scale(hyperparameter.highest) - 0.1 * span)
          << entry.name << hyperparameter.name;
    }
  }
}

TEST(Trials, DependOnSeedNameAndNumberAlone) {
  const EstimatorEntry& entry = estimator_entry("load_filter");
  const std::vector<HyperparameterValues> few = trial_hyperparameters(entry, 1, 3);
  const std::vector<HyperparameterValues> more = trial_hyperparameters(entry, 1, 30);
  EXPECT_EQ(few, std::vector<HyperparameterValues>(more.begin(), more.begin() + 3));
  EXPECT_NE(few[1], trial_hyperparameters(entry, 2, 3)[1]);
  EstimatorEntry renamed = entry;
  renamed.name = "another";
  EXPECT_NE(few[1], trial_hyperparameters(renamed, 1, 3)[1]);
  EXPECT_EQ(few[0], trial_hyperparameters(renamed, 1, 3)[0]);
}

/// All beliefs of an estimator with these hyperparameters on a run, at three noise levels.
std::vector<double> beliefs(const EstimatorEntry& plain,
                            const HyperparameterValues& hyperparameters, const RunSignals& fitted,
                            const RunSignals& run) {
  const EstimatorEntry entry = with_hyperparameters(plain, hyperparameters);
  const RunPointers runs = {&fitted};
  const double skip = scoring::ScoringConfig{}.skip;
  Model model;
  if (entry.fits()) {
    model = entry.fit(runs, skip);
    describe_fit(entry.name, fitted_to(runs, skip), hyperparameters, model);
  }
  EstimatorRunner runner = entry.runner({1000.0, &model, run.legs, &run.contact});
  const NoiseRun noise = noise_run(run, {.seed = 3, .run = 1});
  std::vector<double> all;
  for (const double level : {0.1, 0.7, 2.0}) {
    const scoring::Prediction prediction = predict(runner, run, noise,
                                                   {.knee_torque = level,
                                                    .wheel_torque = 0.2 * level,
                                                    .acceleration = 5.0 * level,
                                                    .hip_torque = level});
    for (std::size_t wheel = 0; wheel < 2; ++wheel) {
      const scoring::Track& track = prediction[wheel];
      all.insert(all.end(), track.p_contact.begin(), track.p_contact.end());
      all.insert(all.end(), track.contact.begin(), track.contact.end());
    }
  }
  return all;
}

/// Tuning an unused hyperparameter would be pointless.
TEST(Trials, ChangeBeliefsByEveryHyperparameter) {
  const RunSignals fitted = synthetic_run(first_fit_run, 1500);
  const RunSignals run = synthetic_run(0, 3000);
  for (const EstimatorEntry& entry : all_estimator_entries()) {
    const std::vector<HyperparameterValues> trials = trial_hyperparameters(entry, 1, 8);
    for (const Hyperparameter& hyperparameter : entry.hyperparameters) {
      // Some need certain values of the others to have an effect.
      const bool counts =
          std::any_of(trials.begin(), trials.end(), [&](HyperparameterValues hyperparameters) {
            hyperparameters[hyperparameter.name] = hyperparameter.lowest;
            const std::vector<double> least = beliefs(entry, hyperparameters, fitted, run);
            hyperparameters[hyperparameter.name] = hyperparameter.highest;
            return least != beliefs(entry, hyperparameters, fitted, run);
          });
      EXPECT_TRUE(counts) << entry.name << " " << hyperparameter.name;
    }
    EXPECT_EQ(beliefs(entry, {}, fitted, run),
              beliefs(entry, trials.empty() ? HyperparameterValues{} : trials.front(), fitted, run))
        << entry.name << ": the first trial is the estimator as it is";
    if (entry.hyperparameters.empty()) {
      EXPECT_THROW((void)entry.chosen("threshold"), Error);
    }
  }
}

RunSignals run_of(const std::string& scene, std::int64_t number) {
  RunSignals run;
  run.info.scenario = scene;
  run.info.run = number;
  return run;
}

bool holds(const RunPointers& runs, const RunSignals& draw) {
  return std::any_of(runs.begin(), runs.end(), [&](const RunSignals* run) {
    return run->info.scenario == draw.info.scenario && run->info.run == draw.info.run;
  });
}

TEST(Folds, HoldOutEveryRunOnceWithItsDraw) {
  // The third and the last are other robots' runs of earlier draws.
  const std::vector<RunSignals> runs = {run_of("stairs", 0), run_of("stairs", 1),
                                        run_of("stairs", 0), run_of("kerb", 2),
                                        run_of("kerb", 3),   run_of("kerb", 2)};
  for (const std::size_t count : {2U, 3U, 4U}) {
    const std::vector<Fold> folds = folds_of(pointers_to(runs), count, true);
    ASSERT_EQ(folds.size(), count);
    std::size_t held_out = 0;
    for (const Fold& fold : folds) {
      held_out += fold.held_out.size();
      EXPECT_FALSE(fold.held_out.empty());
      EXPECT_EQ(fold.held_out.size() + fold.fitted.size(), runs.size());
      for (const RunSignals* run : fold.held_out) EXPECT_FALSE(holds(fold.fitted, *run));
    }
    EXPECT_EQ(held_out, runs.size());
  }
}

TEST(Folds, SpreadEachScene) {
  const std::vector<RunSignals> runs = {run_of("stairs", 0), run_of("stairs", 1), run_of("kerb", 2),
                                        run_of("kerb", 3)};
  for (const Fold& fold : folds_of(pointers_to(runs), 2, true)) {
    ASSERT_EQ(fold.held_out.size(), 2U);
    EXPECT_NE(fold.held_out[0]->info.scenario, fold.held_out[1]->info.scenario);
  }
}

TEST(Folds, CountASceneWithoutPerturbationsAsOneRun) {
  const std::vector<RunSignals> runs = {run_of("stairs", 0), run_of("stairs", 1), run_of("kerb", 2),
                                        run_of("kerb", 3)};
  for (const Fold& fold : folds_of(pointers_to(runs), 2, false)) {
    ASSERT_EQ(fold.held_out.size(), 2U);
    EXPECT_EQ(fold.held_out[0]->info.scenario, fold.held_out[1]->info.scenario);
  }
}

}  // namespace
}  // namespace touchdown::experiments
