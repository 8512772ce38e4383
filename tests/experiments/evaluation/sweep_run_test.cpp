
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/evaluation/scored.hpp"
#include "tests/draws.hpp"
#include "tests/experiments/synthetic_runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

bool always() { return true; }

std::vector<noise::SensorNoise> levels_of(const std::vector<noise::NoiseCell>& cells) {
  std::vector<noise::SensorNoise> levels;
  for (const noise::NoiseCell& cell : cells) levels.push_back(cell.levels());
  return levels;
}

/// Compares the counts of batches and of single levels, by condition. The network's batch equals
/// the network to 1e-5 in probability only. A step with a probability that close to the threshold
/// may have another decision, and the network decides for five steps and two wheels at once.
void expect_batch_equals_one_by_one(const RunSignals& run, bool can_batch) {
  const Experiment experiment = synthetic_experiment(estimator_names(ablation_estimators()));
  const FittedModels models = fit_models(experiment, pointers_to({synthetic_run(first_fit_run)}));
  const std::vector<noise::NoiseCell> cells = noise::noise_cells(experiment.noise);
  ASSERT_EQ(needs_no_guard(run, levels_of(cells)), can_batch);
  const NoiseRun noise = noise_run(run, noise_key(experiment, 1, run.info.run));
  for (const Condition& condition : own_engine_conditions(experiment)) {
    const std::vector<Condition> one = {condition};
    const auto fast = sweep_run(one, cells, run, noise, models, experiment, always);
    const auto slow = sweep_run_one_by_one(one, cells, run, noise, models, experiment, always);
    ASSERT_EQ(fast.size(), cells.size() * run.segments.size());
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

TEST(SweepRun, CountsTheSameInBatchesAsOneByOne) {
  expect_batch_equals_one_by_one(synthetic_run(3), true);
}

TEST(SweepRun, RunsOneByOneWhereASignalGuardWouldReact) {
  RunSignals frozen = synthetic_run(4);
  for (std::size_t k = 1000; k < 1580; ++k) frozen.signals[k].vertical_acceleration = 0.25;
  expect_batch_equals_one_by_one(frozen, false);
  if (!draws_all()) return;
  RunSignals gap = synthetic_run(5);
  for (std::size_t k = 2000; k < gap.steps(); ++k) gap.signals[k].time += 0.1;
  expect_batch_equals_one_by_one(gap, false);
  RunSignals broken = synthetic_run(6);
  broken.signals[700].leg[1].knee.torque = std::nan("");
  expect_batch_equals_one_by_one(broken, false);
  RunSignals absurd = synthetic_run(7);
  absurd.signals[700].leg[0].hip.velocity = 1e39;
  expect_batch_equals_one_by_one(absurd, false);
}

TEST(SweepRun, StopsOnRequest) {
  const Experiment experiment = synthetic_experiment({"robust"});
  const FittedModels models = fit_models(experiment, pointers_to({synthetic_run(first_fit_run)}));
  const RunSignals run = synthetic_run(3);
  const NoiseRun noise = noise_run(run, noise_key(experiment, 0, 3));
  EXPECT_THROW(sweep_run(own_engine_conditions(experiment), noise::noise_cells(experiment.noise),
                         run, noise, models, experiment, [] { return false; }),
               Stopped);
}

TEST(NoiseCells, NameEveryCellOnceAndDistinguishKneesFromWheels) {
  const auto cells = noise::noise_cells(synthetic_experiment({"robust"}).noise);
  ASSERT_EQ(cells.size(), 3U * 3U + 2U * 2U);
  EXPECT_TRUE(std::isnan(cells.back().torque) || cells.back().knee == cells.back().wheel);
  EXPECT_EQ(cells.back().knee, 1.0);
  EXPECT_EQ(cells.back().wheel, 0.5);
  EXPECT_EQ(cells.back().accelerometer, 1.5);
  noise::NoiseGridConfig same;
  same.torque = {0.0, 1.0};
  same.accelerometer = {2.0};
  same.knee_wheel = {{0.0, 1.0}, {0.0, 1.0}, 2.0};
  EXPECT_EQ(noise::noise_cells(same).size(), 4U);
}

// Every combination of cells with and without noise, of one sensor or both, with and without a
// measure: a task that shares scores with other seeds equals one that is computed alone.
TEST(Evaluation, SharesScoresWithoutNoiseBetweenSeeds) {
  for (const bool is_measured : {false, true}) {
    for (const std::vector<noise::NoiseCell>& cells : std::vector<std::vector<noise::NoiseCell>>{
             {{0.0, 0.0}}, {{0.5, 3.0}, {0.0, 0.0}}, {{0.0, 0.0}, {0.0, 3.0}, {0.5, 0.0}}}) {
      Experiment experiment = synthetic_experiment({"robust", "measurement_only", "free_fall"});
      experiment.highlights = cells;
      const FittedModels models =
          fit_models(experiment, pointers_to({synthetic_run(first_fit_run)}));
      Plan plan;
      plan.groups.push_back({"", own_engine_conditions(experiment), {}, cells});
      if (is_measured) {
        plan.groups.back().measures.push_back(
            {.name = "seed", .of_prediction = [](const MeasuredPrediction& made) {
               return std::to_string(made.run.seed);
             }});
      }
      for (const std::int64_t number : {0, 1}) {
        plan.runs.push_back({RunRole::test, "mujoco", {}, number, std::to_string(number)});
      }
      plan_tasks(experiment, 0, plan);
      ASSERT_EQ(plan.tasks.size(), 4U);
      NoiseFreeScores shared;
      for (const Task& task : plan.tasks) {
        const RunSignals run = synthetic_run(plan.runs[task.run].run);
        NoiseFreeScores alone;
        EXPECT_EQ(pack(evaluate(plan, task, run, experiment, models, shared, always)),
                  pack(evaluate(plan, task, run, experiment, models, alone, always)));
      }
    }
  }
}

TEST(Evaluation, EqualsTheSumOfSingleConditions) {
  const ScratchFolder folder;
  Experiment experiment = synthetic_experiment({"robust", "measurement_only"});
  experiment.highlights = {{0.5, 3.0}};
  const FittedModels models = fit_models(experiment, pointers_to({synthetic_run(first_fit_run)}));
  const std::vector<noise::NoiseCell> cells = noise::noise_cells(experiment.noise);
  const std::vector<Condition> conditions = own_engine_conditions(experiment);
  Plan plan;
  plan.groups.push_back({"", conditions, cells, experiment.highlights});
  std::vector<Rollout> runs;
  for (const std::int64_t number : {0, 1}) {
    plan.runs.push_back(
        {RunRole::test, "mujoco", {}, number, "mujoco_test_" + std::to_string(number) + ".mpack"});
    runs.push_back({{plan.runs.back(), {}}, synthetic_run(number)});
  }
  plan_tasks(experiment, 0, plan);
  ASSERT_EQ(plan.tasks.size(), 4U);
  const Store saved(folder.path(), "key");
  const std::vector<std::size_t> both = plan.runs_in(0);
  EXPECT_THROW(score_rows(both, plan, saved), Error);
  // The order of tasks does not matter. Saved tasks are not computed again.
  std::vector<std::size_t> computed;
  for (const std::size_t t : {2U, 3U, 0U, 0U, 1U, 2U, 3U}) {
    NoiseFreeScores noise_free;
    const Task& task = plan.tasks[t];
    if (evaluate_and_save(plan, task, runs.at(task.run), experiment, models, saved, noise_free,
                          always)) {
      computed.push_back(t);
    }
  }
  EXPECT_EQ(computed, (std::vector<std::size_t>{2, 3, 0, 1}));
  EXPECT_FALSE(
      saved_counts(plan, plan.tasks.front(), Store(folder.path(), "other build")).has_value());
  const ScoreRows all = score_rows(both, plan, saved);
  const std::size_t samples = both.size() * runs.front().signals.segments.size();
  ASSERT_EQ(all.counted.size(), conditions.size() * cells.size() * samples);
  ASSERT_EQ(all.scored.size(), conditions.size() * samples);
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    for (std::size_t r = 0; r < both.size(); ++r) {
      const RunSignals& run = runs.at(r).signals;
      std::vector<scoring::Classification> counts(cells.size() * run.segments.size());
      std::vector<scoring::Score> scores(run.segments.size());
      for (int seed = 0; seed < experiment.noise.seeds; ++seed) {
        const NoiseRun noise = noise_run(run, noise_key(experiment, seed, run.info.run));
        const auto alone = sweep_run_one_by_one({&conditions[c], 1}, cells, run, noise, models,
                                                experiment, always);
        for (std::size_t i = 0; i < alone.size(); ++i) counts[i] += alone[i];
        const auto scored =
            scoring::score(run.contact,
                           predict(*make_estimator(experiment, conditions[c], models, run), run,
                                   noise, experiment.highlights[0].levels()),
                           run.segments, run.info.control_period_us, experiment.scoring);
        for (std::size_t i = 0; i < scores.size(); ++i) scores[i] += scored[i].wheels();
      }
      for (std::size_t segment = 0; segment < run.segments.size(); ++segment) {
        const std::size_t sample = r * run.segments.size() + segment;
        for (std::size_t cell = 0; cell < cells.size(); ++cell) {
          const auto& row = all.counted[(c * cells.size() + cell) * samples + sample];
          EXPECT_EQ(row.score, counts[cell * run.segments.size() + segment]);
          EXPECT_EQ(row.run, &plan.runs[both[r]]);
          EXPECT_EQ(*row.condition, conditions[c]);
          EXPECT_EQ(*row.noise, cells[cell]);
        }
        const scoring::Score collected = all.scored[c * samples + sample].score.wheels();
        EXPECT_EQ(collected.points, scores[segment].points);
        EXPECT_EQ(collected.takeoff, scores[segment].takeoff);
        EXPECT_DOUBLE_EQ(collected.calibration.squared_error,
                         scores[segment].calibration.squared_error);
      }
    }
  }
}

}  // namespace
}  // namespace touchdown::experiments
