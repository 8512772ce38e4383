#include "experiments/results/summary_file.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/files.hpp"
#include "experiments/results/captions.hpp"
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
  const Difference difference{"mujoco", {1.0, 5.0}, "robust", "paper", score.metric};
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
  EXPECT_EQ(read.differences.at(0).second, "paper");
}

TEST(Summary, NamesEstimatorsThatNeverReportFlightAndTheFlightsThatTheirFitLacks) {
  Experiment experiment;
  experiment.estimators = {"robust", "paper", "load_filter"};
  experiment.highlights = {{0.0, 0.0}};
  const auto cell = [](const std::string& estimator, double recall) {
    CellSummary one;
    one.condition = {"mujoco", "mujoco", estimator};
    one.cell = {0.0, 0.0};
    one.no_contact_recall = {recall, recall, recall};
    return one;
  };
  const auto note = [&](std::vector<CellSummary> cells, int of_fit, int of_test) {
    std::vector<RunSummary> runs(2);
    runs[0].role = RunRole::fit;
    runs[0].flights = 3;
    runs[0].wheel_flights = of_fit;
    runs[1].flights = 1;
    runs[1].wheel_flights = of_test;
    return score_notes(experiment, {runs, std::move(cells), {}, {}});
  };
  EXPECT_EQ(note({cell("robust", 0.6), cell("paper", NAN)}, 0, 2), "")
      << "found, or no flight at all";
  EXPECT_EQ(note({cell("load_filter", 0.0)}, 0, 2), "") << "is not fitted";
  EXPECT_EQ(note({cell("robust", 0.0), cell("paper", 0.01)}, 0, 2),
            "Bayes filter (robust), Bayes filter (paper) hardly ever report flight, so that they "
            "decide as always contact does. Their fit has no flight of one wheel alone, as the "
            "test has: add scenarios/push_off.yaml to fit.scenarios.");
  const std::string one =
      "Bayes filter (paper) hardly ever reports flight, so that it decides as always "
      "contact does.";
  EXPECT_EQ(note({cell("paper", 0.0)}, 1, 2), one) << "the fit has them";
  EXPECT_EQ(note({cell("paper", 0.0)}, 0, 0), one) << "the test has none";
}

TEST(Summary, NamesATestWithoutAFlightAndEstimatorsThatAreFittedToItsScenes) {
  Experiment experiment;
  experiment.estimators = {"robust", "load_filter", "paper"};
  experiment.fit.scenarios = {"a.yaml", "b.yaml"};
  experiment.test.scenarios = {"c.yaml"};
  const auto note = [&](int of_both, int of_one, logs::Outcome outcome) {
    std::vector<RunSummary> runs(2);
    runs[0].role = RunRole::fit;
    runs[0].flights = 2;
    runs[1].flights = of_both;
    runs[1].wheel_flights = of_one;
    runs[1].outcome = outcome;
    return score_notes(experiment, {runs, {}, {}, {}});
  };
  using enum logs::Outcome;
  const std::string none =
      "The test has no flight of a wheel: no takeoff can be missed, and to answer “contact” always "
      "is right.";
  EXPECT_EQ(note(0, 0, finished), none);
  EXPECT_EQ(note(1, 0, finished), "");
  EXPECT_EQ(note(0, 1, finished), "");
  EXPECT_EQ(note(0, 0, fell), "") << "no run is scored";
  experiment.test.scenarios = {"c.yaml", "b.yaml"};
  const std::string fitted =
      "Fitted to scenes of the test: Bayes filter (robust), Bayes filter (paper).";
  EXPECT_EQ(note(1, 0, finished), fitted);
  EXPECT_EQ(note(0, 0, finished), none + " " + fitted);
}

}  // namespace
}  // namespace touchdown::experiments
