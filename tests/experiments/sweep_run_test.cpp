#include "experiments/sweep_run.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "experiments/estimator_registry.hpp"
#include "experiments/listening.hpp"
#include "experiments/stopped.hpp"
#include "experiments/sweep_lanes.hpp"
#include "synthetic_runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown {
namespace {

bool always() { return true; }

std::vector<NoiseLevels> levels_of(const std::vector<NoiseCell>& cells) {
  std::vector<NoiseLevels> levels;
  for (const NoiseCell& cell : cells) levels.push_back(cell.levels());
  return levels;
}

/// Both ways to count, condition by condition. The network's lanes equal it to 1e-5 in probability
/// only: a step whose probability is that close to the threshold may be decided otherwise, and the
/// network decides for five steps and two wheels at once.
void expect_lanes_equal_one_by_one(const HeardRun& run, bool lanes_apply) {
  const Experiment experiment = synthetic_experiment(estimator_names());
  const FittedModels models = fit_models(experiment, {synthetic_run(first_fit_run)});
  const std::vector<NoiseCell> cells = noise_cells(experiment.noise);
  ASSERT_EQ(needs_no_guard(run, levels_of(cells)), lanes_apply);
  const UnitNoise noise = unit_noise(run, noise_key(experiment, 1, run.info.run));
  for (const Condition& condition : own_engine_conditions(experiment)) {
    const std::vector<Condition> one = {condition};
    const auto fast = sweep_run(one, cells, run, noise, models, experiment.scoring, always);
    const auto slow =
        sweep_run_one_by_one(one, cells, run, noise, models, experiment.scoring, always);
    ASSERT_EQ(fast.size(), cells.size() * run.pieces.size());
    ASSERT_EQ(slow.size(), fast.size());
    const std::int64_t tolerance = condition.estimator == "nmn" ? 10 : 0;
    for (std::size_t i = 0; i < fast.size(); ++i) {
      const auto& name = condition.estimator;
      EXPECT_EQ(fast[i].contact(), slow[i].contact()) << name << " " << i;
      EXPECT_EQ(fast[i].flight(), slow[i].flight()) << name << " " << i;
      EXPECT_LE(std::abs(fast[i].contact_as_contact - slow[i].contact_as_contact), tolerance)
          << name << " " << i;
      EXPECT_LE(std::abs(fast[i].flight_as_flight - slow[i].flight_as_flight), tolerance)
          << name << " " << i;
    }
  }
}

TEST(SweepRun, CountsInLanesWhatItCountsOneByOne) {
  expect_lanes_equal_one_by_one(synthetic_run(3), true);
}

TEST(SweepRun, ListensOneByOneWhereASignalGuardWouldStepIn) {
  HeardRun frozen = synthetic_run(4);
  for (std::size_t k = 1000; k < 1580; ++k) frozen.signals[k].vertical_acceleration = 0.25;
  expect_lanes_equal_one_by_one(frozen, false);
  HeardRun gap = synthetic_run(5);
  for (std::size_t k = 2000; k < gap.steps(); ++k) gap.signals[k].time += 0.1;
  expect_lanes_equal_one_by_one(gap, false);
  HeardRun broken = synthetic_run(6);
  broken.signals[700].leg[1].knee.torque = std::nan("");
  expect_lanes_equal_one_by_one(broken, false);
}

TEST(SweepRun, StopsWhenAsked) {
  const Experiment experiment = synthetic_experiment({"robust"});
  const FittedModels models = fit_models(experiment, {synthetic_run(first_fit_run)});
  const HeardRun run = synthetic_run(3);
  const UnitNoise noise = unit_noise(run, noise_key(experiment, 0, 3));
  EXPECT_THROW(sweep_run(own_engine_conditions(experiment), noise_cells(experiment.noise), run,
                         noise, models, experiment.scoring, [] { return false; }),
               Stopped);
}

TEST(NoiseCells, NameEveryCellOnceAndTellKneesFromWheels) {
  const auto cells = noise_cells(synthetic_experiment({"robust"}).noise);
  ASSERT_EQ(cells.size(), 3U * 3U + 2U * 2U);
  EXPECT_TRUE(std::isnan(cells.back().torque) || cells.back().knee == cells.back().wheel);
  EXPECT_EQ(cells.back().knee, 1.0);
  EXPECT_EQ(cells.back().wheel, 0.5);
  EXPECT_EQ(cells.back().accelerometer, 1.5);
  NoiseGridConfig same;
  same.torque = {0.0, 1.0};
  same.accelerometer = {2.0};
  same.knee_wheel = {{0.0, 1.0}, {0.0, 1.0}, 2.0};
  EXPECT_EQ(noise_cells(same).size(), 4U);
}

TEST(Listening, AddsUpToWhatASweepCounts) {
  const ScratchFolder folder;
  Experiment experiment = synthetic_experiment({"robust", "measurement_only"});
  experiment.highlights = {{0.5, 3.0}};
  const FittedModels models = fit_models(experiment, {synthetic_run(first_fit_run)});
  const std::vector<HeardRun> runs = {synthetic_run(0), synthetic_run(1)};
  const std::vector<NoiseCell> cells = noise_cells(experiment.noise);
  std::vector<PlannedRun> plan;
  for (const HeardRun& run : runs) {
    plan.push_back({RunRole::test,
                    "mujoco",
                    {},
                    run.info.run,
                    "mujoco_test_" + std::to_string(run.info.run) + ".mpack"});
  }
  const SavedListening saved(folder.path(), "key");
  const std::vector<ListeningTask> tasks = listening_tasks(experiment, plan);
  ASSERT_EQ(tasks.size(), 4U);
  EXPECT_THROW(collect(experiment, cells, plan, tasks, saved), Error);
  // In whatever order they come.
  for (const std::size_t t : {2U, 0U, 3U, 1U}) {
    const HeardRun& run = runs[tasks[t].run];
    saved.write(SavedListening::name(plan[tasks[t].run], tasks[t].seed),
                listen(experiment, cells, run, tasks[t].seed, models, always));
  }
  EXPECT_FALSE(SavedListening(folder.path(), "other build")
                   .read(SavedListening::name(plan[0], 0))
                   .has_value());
  const CollectedListening all = collect(experiment, cells, plan, tasks, saved);
  const std::vector<const HeardRun*> heard = {&runs[0], &runs[1]};
  const auto conditions = own_engine_conditions(experiment);
  const auto counts = sweep(experiment, conditions, cells, heard, models,
                            [](std::int64_t /*cells*/) { return true; });
  ASSERT_EQ(all.counts.size(), counts.size());
  for (std::size_t c = 0; c < counts.size(); ++c) {
    EXPECT_EQ(all.counts[c].samples, counts[c].samples);
    EXPECT_EQ(counts[c].samples[0].size(), 4U);  // two runs of two pieces
  }
  const auto scores = score_conditions(experiment, conditions, experiment.highlights[0], 2, heard,
                                       models, [](std::int64_t /*cells*/) { return true; });
  ASSERT_EQ(all.highlights.size(), 1U);
  for (std::size_t c = 0; c < scores.size(); ++c) {
    ASSERT_EQ(all.highlights[0][c].samples.size(), scores[c].samples.size());
    for (std::size_t i = 0; i < scores[c].samples.size(); ++i) {
      const Score collected = all.highlights[0][c].samples[i].wheels();
      const Score scored = scores[c].samples[i].wheels();
      EXPECT_EQ(collected.points, scored.points);
      EXPECT_EQ(collected.takeoff, scored.takeoff);
      EXPECT_EQ(collected.calibration.squared_error, scored.calibration.squared_error);
    }
  }
}

}  // namespace
}  // namespace touchdown
