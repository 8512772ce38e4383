#include "experiments/results/summary_file.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/files.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

TEST(SummaryFile, ReadsBackAsWrittenAndRoundedAsTheTables) {
  const Condition condition{"bullet", "mujoco", "robust"};
  CellSummary cell;
  cell.condition = condition;
  cell.cell = {NAN, 5.0, 0.1 + 0.2, 2.0};
  cell.success = {2.0 / 3.0, 0.5, 1.0};
  cell.no_contact_recall = {NAN, NAN, NAN};
  cell.always_contact = 0.1234567;
  ScoreSummary score{condition, {0.25, 0.23}, "wheels", {}, {}, {}};
  score.metric.assign(scoring::metrics().size(), {1.0, 0.0, NAN});
  score.metric[scoring::metric_index("brier")] = {0.0000004, 0.25, 0.5};
  const Difference difference{"mujoco", {1.0, 5.0}, "robust", "phase", score.metric};
  const ScratchFolder folder;
  const std::vector<RunSummary> runs = {
      {RunRole::fit, "bullet", 1000000, "a.mpack", logs::Outcome::fell, 3}};
  write_summary({runs, {cell}, {score}, {difference}}, folder.path());
  const std::string written = read_file(folder / "tables/summary.json");
  const Summary read = read_summary(folder.path());
  write_summary(read, folder.path());
  EXPECT_EQ(read_file(folder / "tables/summary.json"), written);

  EXPECT_EQ(read.runs.at(0).role, RunRole::fit);
  EXPECT_EQ(read.runs.at(0).run, 1000000);
  EXPECT_EQ(read.runs.at(0).outcome, logs::Outcome::fell);
  EXPECT_EQ(read.cells.at(0).condition.fit_simulator, "bullet");
  EXPECT_EQ(read.cells.at(0).condition.test_simulator, "mujoco");
  EXPECT_TRUE(std::isnan(read.cells.at(0).cell.torque));
  EXPECT_EQ(read.cells.at(0).cell, cell.cell);  // to the last bit
  EXPECT_EQ(read.cells.at(0).success.estimate, 0.666667);
  EXPECT_EQ(read.cells.at(0).success.high, 1.0);
  EXPECT_TRUE(std::isnan(read.cells.at(0).no_contact_recall.estimate));
  EXPECT_EQ(read.cells.at(0).always_contact, 0.123457);
  EXPECT_EQ(read.scores.at(0)["brier"].estimate, 0.0);
  EXPECT_EQ(read.scores.at(0)["success"].estimate, 1.0);
  EXPECT_TRUE(std::isnan(read.scores.at(0)["success"].high));
  EXPECT_EQ(read.differences.at(0).second, "phase");
}

}  // namespace
}  // namespace touchdown::experiments
