#include "experiments/cost_estimate.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/calibration.hpp"
#include "experiments/run_experiment.hpp"
#include "experiments/stages/experiment_context.hpp"
#include "experiments/stages/needs.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "tests/experiments/small_step_scene.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

/// Both engines, one noise setting and one noise seed; two runs are fitted and four tested.
Experiment small(const ScratchFolder& folder, const std::string& more = "") {
  const std::string scene = folder.write("step.yaml", small_step_scene).string();
  const bool is_tuned = more.find("tuning") != std::string::npos;
  return experiment_from_yaml(YamlDocument::parse(
      "name: small\nestimators: [robust, force_kinematics, free_fall]\n"
      "fit: {scenarios: [" +
          scene + "], runs: 2, perturbed: true" + (is_tuned ? ", tuning: {trials: 3}" : "") +
          "}\ntest: {scenarios: [" + scene +
          "], runs: 4}\nnoise: {torque: [0.0], accelerometer: [0.0], seeds: 1}\nworkers: 2\n"
          "recordings: none\nvideo: {enabled: false}\n" +
          (is_tuned ? "" : more),
      "small.yaml"));
}

constexpr double run_seconds = 4.0;
constexpr double run_steps = 4'000.0;
constexpr double simulated_pair = 28e-3;  // one run on each engine (s)

/// Round numbers, as if they had been measured.
Calibration round_numbers() {
  Calibration known;
  known.step_seconds = {{"mujoco", 2e-6}, {"bullet", 5e-6}};
  known.share = run_seconds / 6.0;  // of the scene's planned duration
  known.fits.costs = {
      {.estimator = "robust", .fixed = 1.0, .per_second = 0.5, .memory = 3e6, .is_tuned = true},
      {.estimator = "force_kinematics", .per_second = 0.25, .memory = 1e9}};
  known.evaluation = {.counted = {0.5, 1e-3}, .scored = {0.25, 2e-3}, .tried = {0.125, 1e-3}};
  known.memory_in_use = 7e7;
  return known;
}

CostEstimate estimate(const Experiment& experiment,
                      const Calibration& calibration = round_numbers()) {
  const RunRequest request = request_of(experiment);
  return estimate_cost(request, whole_plan(request), calibration);
}

double stage(const CostEstimate& cost, const std::string& name) {
  for (const StageCost& one : cost.stages) {
    if (one.stage == name) return one.seconds;
  }
  return std::nan("");
}

TEST(CostEstimate, GrowsWithTheRunsInEveryStageThatDependsOnThem) {
  const ScratchFolder folder;
  Experiment experiment = small(folder);
  const CostEstimate few = estimate(experiment);
  EXPECT_DOUBLE_EQ(stage(few, "simulate"), (2.0 + 4.0) * simulated_pair);
  EXPECT_DOUBLE_EQ(stage(few, "fit"), 2.0 * (1.0 + 0.75 * 2.0 * run_seconds));
  EXPECT_DOUBLE_EQ(stage(few, "evaluate"), 8.0 * (0.75 + run_steps * 3e-3));
  EXPECT_TRUE(std::isnan(stage(few, "tune")));
  EXPECT_DOUBLE_EQ(few.seconds(),
                   stage(few, "simulate") + stage(few, "fit") + stage(few, "evaluate"));
  experiment.test.runs = 40;
  const CostEstimate many = estimate(experiment);
  EXPECT_DOUBLE_EQ(stage(many, "simulate"), (2.0 + 40.0) * simulated_pair);
  EXPECT_DOUBLE_EQ(stage(many, "fit"), stage(few, "fit"));
  EXPECT_DOUBLE_EQ(stage(many, "evaluate"), 10.0 * stage(few, "evaluate"));
  EXPECT_GT(many.disk, few.disk);
  experiment.fit.runs = 6;
  EXPECT_DOUBLE_EQ(stage(estimate(experiment), "fit"), 2.0 * (1.0 + 0.75 * 6.0 * run_seconds));
}

TEST(CostEstimate, AddsTheGrowthOfMemoryToWhatTheProcessHolds) {
  const ScratchFolder folder;
  Experiment experiment = small(folder);
  const double few = estimate(experiment).memory;
  // Without studies the signals of test runs are held: of 72 more runs.
  experiment.test.runs = 40;
  const double many = estimate(experiment).memory;
  const double held = 72.0 * run_steps * signal_bytes_per_step(false);
  EXPECT_NEAR(many - few, held, 1.0);
  // Whatever an allocator or a sanitizer keeps is in the estimate once.
  for (const double in_use : {0.0, 1e6, 5e9}) {
    Calibration calibration = round_numbers();
    calibration.memory_in_use = in_use;
    EXPECT_NEAR(estimate(experiment, calibration).memory, many - 7e7 + in_use, 1.0);
  }
  // Two threads fit at once; with one, the larger fit counts alone.
  experiment.workers = 1;
  EXPECT_NEAR(many - estimate(experiment).memory, 3e6, 1.0);
  // Fits that need less than two simulations at once do not count.
  Calibration calibration = round_numbers();
  experiment.workers = 2;
  for (FitCost& cost : calibration.fits.costs) cost.memory = 1.0;
  const double without_fits = estimate(experiment, calibration).memory;
  for (FitCost& cost : calibration.fits.costs) cost.memory = 2.0;
  EXPECT_EQ(estimate(experiment, calibration).memory, without_fits);
}

TEST(CostEstimate, TakesTheDurationOfASimulatedRunOfTheScene) {
  const ScratchFolder folder;
  const Experiment experiment = small(folder);
  Calibration calibration = round_numbers();
  const RunRequest request = request_of(experiment);
  calibration.duration[scene_key(whole_plan(request).runs.front())] = 0.5 * run_seconds;
  EXPECT_DOUBLE_EQ(stage(estimate(experiment, calibration), "simulate"),
                   0.5 * stage(estimate(experiment), "simulate"));
  calibration.step_seconds.erase("bullet");  // no run of it could be simulated
  EXPECT_DOUBLE_EQ(stage(estimate(experiment, calibration), "simulate"), 6.0 * 0.5 * 8e-3);
  const CostEstimate nothing = estimate(experiment, {});
  EXPECT_EQ(nothing.seconds(), 0.0);
  EXPECT_GT(nothing.memory, 0.0);
}

TEST(CostEstimate, CountsTrialsRefitsRobotsAndSensors) {
  const ScratchFolder folder;
  const CostEstimate plain = estimate(small(folder));
  // Two folds of half the fitted runs: every trial fits `robust`, but not `force_kinematics`.
  const double fits = 2.0 * (3.0 * (1.0 + 0.5 * run_seconds) + 0.25 * run_seconds);
  const double evaluated = 3.0 * (2.0 * 0.125 + 2.0 * run_steps * 1e-3);
  EXPECT_DOUBLE_EQ(stage(estimate(small(folder, "tuning")), "tune"), 2.0 * (fits + evaluated));

  const Experiment refitted = small(folder, "benchmark: {refits: 9}\n");
  EXPECT_DOUBLE_EQ(stage(estimate(refitted), "fit"), 10.0 * stage(plain, "fit"));
  Calibration bounded = round_numbers();
  bounded.fits.costs.back().is_upper_bound = true;  // upper bounds are fitted once
  const double robust = 2.0 * (1.0 + 0.5 * 2.0 * run_seconds);
  EXPECT_DOUBLE_EQ(stage(estimate(refitted, bounded), "fit"), stage(plain, "fit") + 9.0 * robust);

  // Two robots, each with two sensors, have fits of their own; sensors share test runs.
  const CostEstimate wide = estimate(small(
      folder, "benchmark: {robots: [models/upkie_heavy.yaml], sensors: [sensors/upkie.yaml]}\n"));
  EXPECT_DOUBLE_EQ(stage(wide, "fit"), 4.0 * stage(plain, "fit"));
  EXPECT_DOUBLE_EQ(stage(wide, "simulate"), (4.0 * 2.0 + 2.0 * 4.0) * simulated_pair);
  EXPECT_DOUBLE_EQ(stage(wide, "evaluate"),
                   4.0 * 8.0 * (0.25 + run_steps * 2e-3) + 8.0 * (0.5 + run_steps * 1e-3));
}

TEST(Calibration, MeasuresEnginesScenesFitsAndEvaluations) {
  const ScratchFolder folder;
  for (const std::string more : {"", "tuning"}) {
    const RunRequest request = request_of(small(folder, more));
    const Calibration found = calibrate(request, whole_plan(request), [] { return true; });
    ASSERT_EQ(found.step_seconds.size(), 2U);
    for (const auto& [engine, seconds] : found.step_seconds) EXPECT_GT(seconds, 0.0) << engine;
    ASSERT_EQ(found.duration.size(), 1U);
    const double duration = found.duration.begin()->second;
    EXPECT_GT(duration, 3.0);
    EXPECT_LT(duration, 5.0);
    EXPECT_GT(found.share, 0.5);
    EXPECT_LT(found.share, 0.9);
    std::vector<std::string> fitted;
    for (const FitCost& cost : found.fits.costs) {
      fitted.push_back(cost.estimator);
      EXPECT_GT(cost.of(1.0), 0.0) << cost.estimator;
      EXPECT_GE(cost.memory, 0.0) << cost.estimator;
    }
    EXPECT_THAT(fitted, ::testing::ElementsAre("robust", "force_kinematics"));
    const auto is_measured = [](const RunCost& cost) { return cost.fixed + cost.per_step > 0.0; };
    EXPECT_TRUE(is_measured(found.evaluation.scored));
    EXPECT_EQ(is_measured(found.evaluation.tried), more == "tuning");
    EXPECT_GT(found.memory_in_use, 0.0);
    EXPECT_GT(found.measured, 0.0);
  }
}

TEST(Calibration, SimulatesFittedScenesHoweverManyAreTested) {
  const ScratchFolder folder;
  Experiment experiment = small(folder);
  const auto write = [&](const std::string& name) {
    std::string scene = small_step_scene;
    scene.replace(scene.find("small_step"), 10, name);
    scene.replace(scene.find("duration: 6.0"), 13, "duration: 0.6");
    return folder.write(name + ".yaml", scene).string();
  };
  for (int i = 0; i < 4; ++i) experiment.fit.scenarios.push_back(write(fmt::format("fit_{}", i)));
  for (int i = 0; i < 30; ++i) experiment.test.scenarios.push_back(write(fmt::format("it_{}", i)));
  const RunRequest request = request_of(experiment);
  const Calibration found = calibrate(request, whole_plan(request), [] { return true; });
  EXPECT_LT(found.duration.size(), 24U);
  int fitted = 0;
  for (const auto& [scene, seconds] : found.duration) fitted += scene.first.starts_with("fit_");
  EXPECT_EQ(fitted, 4);
  EXPECT_EQ(found.fits.costs.size(), 2U);
  EXPECT_THAT(found.fits.unmeasured, ::testing::IsEmpty());
}

TEST(Calibration, NamesFitsThatNeedMoreData) {
  const ScratchFolder folder;
  std::string scene = small_step_scene;  // ends before the robot leaves the ground
  scene.replace(scene.find("duration: 6.0"), 13, "duration: 0.8");
  folder.write("short.yaml", scene);
  const RunRequest request = request_of(experiment_from_yaml(YamlDocument::parse(
      "name: short\nestimators: [phase, robust]\nfit: {scenarios: [" +
          (folder / "short.yaml").string() + "], runs: 2, perturbed: true}\ntest: {scenarios: [" +
          (folder / "short.yaml").string() + "], runs: 1}\nvideo: {enabled: false}\n",
      "short.yaml")));
  const RunOutline outline =
      outline_of(request.experiment, {.out = folder / "run", .command = "test"});
  EXPECT_THAT(outline.cost.unmeasured_fits, ::testing::Contains("phase"));
}

TEST(Calibration, WritesNothingAndStopsWhenAsked) {
  const ScratchFolder folder;
  const Experiment experiment = small(folder);
  const RunOutline outline = outline_of(experiment, {.out = folder / "run", .command = "test"});
  EXPECT_FALSE(std::filesystem::exists(folder / "run"));
  EXPECT_GT(outline.cost.seconds(), 0.0);
  EXPECT_GT(outline.cost.memory, 0.0);
  const RunRequest request = request_of(experiment);
  EXPECT_THROW((void)calibrate(request, whole_plan(request), [] { return false; }), Stopped);
}

}  // namespace
}  // namespace touchdown::experiments
