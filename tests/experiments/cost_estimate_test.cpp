#include "experiments/cost_estimate.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/experiment_context.hpp"
#include "experiments/needs.hpp"
#include "experiments/run_experiment.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "tests/experiments/small_step_scene.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

/// One engine or both, with estimators that fit densities, parameters and nothing.
Experiment small(const ScratchFolder& folder, const std::string& more = "") {
  const std::string scene = folder.write("step.yaml", small_step_scene).string();
  return experiment_from_yaml(YamlDocument::parse(
      "name: small\nestimators: [robust, force_kinematics, free_fall]\n"
      "fit: {scenarios: [" +
          scene + "], runs: 2, perturbed: true" +
          (more.find("tuning") == std::string::npos ? "" : ", tuning: {trials: 3}") +
          "}\ntest: {scenarios: [" + scene +
          "], runs: 4}\nrecordings: none\nvideo: {enabled: false}\n" +
          (more.find("tuning") == std::string::npos ? more : ""),
      "small.yaml"));
}

CostEstimate estimate(const Experiment& experiment) {
  const RunRequest request = request_of(experiment);
  return estimate_cost(request, whole_plan(request), [] { return true; });
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
  experiment.test.runs = 40;
  const CostEstimate many = estimate(experiment);
  EXPECT_GT(stage(many, "evaluate"), 4.0 * stage(few, "evaluate"));
  EXPECT_GT(stage(many, "simulate"), 3.0 * stage(few, "simulate"));
  // Without studies the signals of test runs are held: of 72 more runs, three to five seconds each.
  // What this process holds besides varies.
  const double signals_of_a_second = 72.0 * 1'000.0 * signal_bytes_per_step(false);
  EXPECT_GT(many.memory - few.memory, 3.0 * signals_of_a_second);
  EXPECT_LT(many.memory - few.memory, 8.0 * signals_of_a_second);
  EXPECT_GT(many.disk, few.disk);
  EXPECT_EQ(few.step_seconds.size(), 2U);
  EXPECT_TRUE(std::isnan(stage(few, "tune")));
}

TEST(CostEstimate, CountsTrialsRefitsRobotsAndSensors) {
  const ScratchFolder folder;
  const CostEstimate plain = estimate(small(folder));
  EXPECT_GT(stage(estimate(small(folder, "tuning")), "tune"), 0.5 * stage(plain, "fit"));
  const CostEstimate refitted = estimate(small(folder, "benchmark: {refits: 9}\n"));
  EXPECT_GT(stage(refitted, "fit"), 4.0 * stage(plain, "fit"));
  const CostEstimate wide = estimate(small(
      folder, "benchmark: {robots: [models/upkie_heavy.yaml], sensors: [sensors/upkie.yaml]}\n"));
  EXPECT_GT(stage(wide, "evaluate"), 2.0 * stage(plain, "evaluate"));
}

TEST(CostEstimate, WritesNothingAndStopsWhenAsked) {
  const ScratchFolder folder;
  const Experiment experiment = small(folder);
  const RunOutline outline = outline_of(experiment, {.out = folder / "run", .command = "test"});
  EXPECT_FALSE(std::filesystem::exists(folder / "run"));
  EXPECT_GT(outline.cost.seconds(), 0.0);
  const RunRequest request = request_of(experiment);
  EXPECT_THROW((void)estimate_cost(request, whole_plan(request), [] { return false; }), Stopped);
}

}  // namespace
}  // namespace touchdown::experiments
