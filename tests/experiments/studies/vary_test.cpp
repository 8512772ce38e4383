#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/rows.hpp"
#include "core/table.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/run_experiment.hpp"
#include "tests/complaint.hpp"
#include "tests/experiments/small_step_scene.hpp"
#include "tests/experiments/studies/study_test.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;

/// Two runs over a small step, evaluated by a filter with these changes.
Experiment varied(const ScratchFolder& folder, const std::string& keys) {
  const std::string scene = folder.write("small_step.yaml", small_step_scene).string();
  return experiment_from_yaml(YamlDocument::parse(
      "name: varied\n"
      "simulators: [mujoco]\n"
      "estimators: [measurement_only]\n"
      "fit: {scenarios: [" +
          scene + "], runs: 2, perturbed: true}\ntest: {scenarios: [" + scene +
          "], runs: 2}\nrecordings: none\nvideo: {enabled: false}\nvary: " + keys + "\n",
      "varied.yaml"));
}

TEST(AVariedQuantity, EvaluatesTheExperimentsOwnRunsForEveryValue) {
  const ScratchFolder folder;
  const Experiment experiment =
      varied(folder, "{sensors.torque.white: [0, 2], sensors.dropout: [0]}");
  const ExperimentResult result = run_in(folder, experiment);
  const Table table = result.directory.read_table("vary.csv");
  ASSERT_EQ(table.rows.size(), 6U);  // three values, the filter and always contact
  const auto success = [&](std::size_t row) { return TableRow(table, row).number("success"); };
  const auto own = where(result.tables.scores.all(), [](const TableRow& score) {
    return score.text("view") == "wheels" && score.text("estimator") == "measurement_only";
  });
  EXPECT_EQ(success(0), own.at(0).number("success"));  // a value without effect
  EXPECT_EQ(success(4), success(0));
  EXPECT_LT(success(2), success(0) - 0.05);
  EXPECT_EQ(success(3), success(1));  // always contact uses no sensor
  EXPECT_THAT(result.studies.back(), HasSubstr("sensors.torque.white, mujoco"));
  ASSERT_EQ(result.figures.size(), 1U);
  EXPECT_EQ(result.figures[0].name, "vary_mujoco");
  ASSERT_EQ(result.figures[0].panels.groups.size(), 2U);
  EXPECT_EQ(result.figures[0].panels.groups[0].title, "sensors.torque.white");
  EXPECT_EQ(result.figures[0].panels.groups[1].title, "sensors.dropout");
}

TEST(AVariedQuantity, OfTheSensorsSimulatesNothingTwice) {
  const ScratchFolder folder;
  const Plan plan = whole_plan(request_of(varied(folder, "{sensors.delay: [0.001, 0.002]}")));
  ASSERT_EQ(plan.groups.size(), 3U);
  for (std::size_t group = 1; group < plan.groups.size(); ++group) {
    const auto runs = plan.runs_in(group);
    ASSERT_EQ(runs.size(), 2U);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      EXPECT_EQ(plan.runs[runs[i]].file, plan.runs[plan.runs_in(0)[i]].file);
    }
    const noise::SensorProfile& sensors = plan.sensors[plan.runs[runs[0]].sensors].profile;
    EXPECT_EQ(sensors.torque[1].delay, 0.001 * static_cast<double>(group));
  }
  EXPECT_EQ(plan.tasks.size(), 3 * 2U);
}

TEST(AVariedQuantity, OfTheSceneChangesItsRunsAndCountsThoseThatFell) {
  const ScratchFolder folder;
  const Experiment experiment =
      varied(folder, "{terrain.pieces.1.step.drop: [0.2, 3], terrain.friction: [0.7]}");
  const Plan plan = whole_plan(request_of(experiment));
  ASSERT_EQ(plan.groups.size(), 4U);
  const std::vector<std::size_t> runs = plan.runs_in(3);
  ASSERT_EQ(runs.size(), 2U);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const PlannedRun& own = plan.runs[plan.runs_in(0)[i]];
    const PlannedRun& run = plan.runs[runs[i]];
    EXPECT_EQ(run.scenario.terrain.friction, 0.7);
    EXPECT_EQ(run.scenario.start.x, own.scenario.start.x);  // the same draw
    EXPECT_NE(run.file, own.file);
  }
  const ExperimentResult result = run_in(folder, experiment);
  const Table table = result.directory.read_table("vary.csv");
  const auto number = [&](std::size_t row, const char* column) {
    return TableRow(table, row).number(column);
  };
  ASSERT_EQ(table.rows.size(), 6U);
  EXPECT_EQ(number(0, "failed"), 0.0);
  EXPECT_EQ(number(0, "runs"), 2.0);
  EXPECT_EQ(number(2, "failed"), 2.0);  // from 3 m
  EXPECT_EQ(number(2, "runs"), 0.0);
  EXPECT_TRUE(std::isnan(number(2, "success")));
  EXPECT_THAT(result.studies.back(), HasSubstr("(2 fell)"));
}

TEST(AVariedQuantity, HasEachValueOnce) {
  const ScratchFolder folder;
  for (const char* keys :
       {"{sensors.dropout: [0.1, 0.2, 0.1]}", "{terrain.friction: [0.5, .50]}"}) {
    EXPECT_THAT(complaint_of([&] { (void)outline_of(varied(folder, keys), {}); }),
                HasSubstr("are planned twice"))
        << keys;
  }
}

}  // namespace
}  // namespace touchdown::experiments
