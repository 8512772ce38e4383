#include <atomic>
#include <cstddef>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "estimator/bayes/ablation.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/run_experiment.hpp"
#include "tests/experiments/studies/study_test.hpp"

namespace touchdown::experiments {
namespace {

/// What an experiment's estimator was asked to do, and when to stop.
struct Asked {
  std::atomic<int> fits = 0;
  std::atomic<int> made = 0;
  int stop_after = 1'000'000;  ///< estimators that were made
  std::atomic<bool> stop = false;
};
Asked asked;

/// An estimator that the registry does not have, so that an experiment may bring it along.
EstimatorEntry ablation_step() {
  const AblationStep step = steps_from_paper_to_robust().front();
  return bayes_entry(step.name, "", "", step.config);
}

std::unique_ptr<ContactEstimator> counted_make(const EstimatorEntry& entry,
                                               const EstimatorSetup& setup) {
  if (++asked.made >= asked.stop_after) asked.stop = true;
  return ablation_step().making.by_step(entry, setup);
}

Model counted_fit(const EstimatorEntry& entry, FitRuns runs, double skip) {
  ++asked.fits;
  return ablation_step().fitting.fit(entry, runs, skip);
}

/// Six test runs in two engines with two noise seeds each; no recording is kept.
Experiment counted_experiment(const ScratchFolder& folder) {
  const std::string scene = folder.write("small_step.yaml", small_step_scene).string();
  Experiment experiment;
  experiment.name = "resume";
  experiment.external_estimators = {ablation_step()};
  EstimatorEntry& counted = experiment.external_estimators.front();
  experiment.estimators = {counted.name};
  counted.fitting.fit = counted_fit;
  counted.making.by_step = counted_make;
  counted.batching = nullptr;
  experiment.fit = {.scenarios = {scene}, .runs = 2};
  experiment.test = {.scenarios = {scene}, .runs = 3};
  experiment.noise.seeds = 2;
  experiment.noise.torque = {0.5};
  experiment.highlights = {{0.5, 0.0}};
  experiment.video.enabled = false;
  experiment.recordings = KeptRecordings::none;
  experiment.workers = 1;
  return experiment;
}

TEST(AStoppedRun, LosesNothingThatWasFinished) {
  const ScratchFolder folder;
  const Experiment experiment = counted_experiment(folder);
  run_in(folder, experiment, "whole");
  const int made_by_whole = asked.made.exchange(0);
  EXPECT_EQ(asked.fits.exchange(0), 2) << "one per engine";
  const int made_by_task = made_by_whole / (2 * 3 * 2);

  for (const int share : {1, 2, 3, 5, 9, 11}) {
    const std::string name = "stopped_" + std::to_string(share);
    asked.stop_after = share * made_by_task;
    const RunOptions options{.out = folder / name, .command = "test", .stop = &asked.stop};
    EXPECT_THROW(run_experiment(experiment, options), Stopped) << share;
    asked.stop_after = 1'000'000;
    asked.stop = false;
    run_experiment(experiment, options);
    EXPECT_EQ(asked.fits.exchange(0), 2) << share;
    EXPECT_LE(asked.made.exchange(0), made_by_whole + made_by_task) << share;
    for (const char* table : {"success.csv", "ranking.csv", "runs.csv", "results.csv"}) {
      EXPECT_EQ(read_file(folder / name / "tables" / table),
                read_file(folder / "whole/tables" / table))
          << table;
    }
  }
}

TEST(AFinishedRun, IsReadAgainWithoutAnyComputation) {
  const ScratchFolder folder;
  const Experiment experiment = counted_experiment(folder);
  run_in(folder, experiment);
  const std::string before = read_file(folder / "run/tables/results.csv");
  asked.fits = asked.made = 0;
  run_in(folder, experiment);
  EXPECT_EQ(asked.fits, 0);
  EXPECT_EQ(asked.made, 0);
  EXPECT_EQ(read_file(folder / "run/tables/results.csv"), before);
}

}  // namespace
}  // namespace touchdown::experiments
