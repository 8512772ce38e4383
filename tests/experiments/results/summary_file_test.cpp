#include "experiments/results/summary_file.hpp"

#include <cmath>

#include <gtest/gtest.h>

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
  write_summary({{{RunRole::fit, "bullet", 1000000, "a.mpack", recordings::Outcome::fell, 3}},
                 {cell},
                 {score},
                 {difference}},
                folder.path());
  const Summary read = read_summary(folder.path());

  ASSERT_EQ(read.runs.size(), 1U);
  EXPECT_EQ(read.runs[0].role, RunRole::fit);
  EXPECT_EQ(read.runs[0].simulator, "bullet");
  EXPECT_EQ(read.runs[0].run, 1000000);
  EXPECT_EQ(read.runs[0].recording, "a.mpack");
  EXPECT_EQ(read.runs[0].outcome, recordings::Outcome::fell);
  EXPECT_EQ(read.runs[0].flights, 3);

  ASSERT_EQ(read.cells.size(), 1U);
  EXPECT_EQ(read.cells[0].condition.fit_simulator, "bullet");
  EXPECT_EQ(read.cells[0].condition.test_simulator, "mujoco");
  EXPECT_EQ(read.cells[0].condition.estimator, "robust");
  EXPECT_TRUE(std::isnan(read.cells[0].cell.torque));
  EXPECT_EQ(read.cells[0].cell, cell.cell);  // to the last bit
  EXPECT_EQ(read.cells[0].success.estimate, 0.666667);
  EXPECT_EQ(read.cells[0].success.high, 1.0);
  EXPECT_TRUE(std::isnan(read.cells[0].no_contact_recall.estimate));
  EXPECT_EQ(read.cells[0].always_contact, 0.123457);

  ASSERT_EQ(read.scores.size(), 1U);
  EXPECT_EQ(read.scores[0].cell, score.cell);
  EXPECT_EQ(read.scores[0].view, "wheels");
  EXPECT_EQ(read.scores[0]["brier"].estimate, 0.0);
  EXPECT_EQ(read.scores[0]["success"].estimate, 1.0);
  EXPECT_TRUE(std::isnan(read.scores[0]["success"].high));

  ASSERT_EQ(read.differences.size(), 1U);
  EXPECT_EQ(read.differences[0].simulator, "mujoco");
  EXPECT_EQ(read.differences[0].first, "robust");
  EXPECT_EQ(read.differences[0].second, "phase");
  EXPECT_EQ(read.differences[0].metric.size(), scoring::metrics().size());
}

}  // namespace
}  // namespace touchdown::experiments
