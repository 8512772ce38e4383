#include <cmath>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "core/columns.hpp"
#include "experiments/results/captions.hpp"

namespace touchdown::experiments {
namespace {

struct OneRun {
  std::string role;
  std::int64_t flights = 0;
  std::int64_t of_one_wheel = 0;
  std::string outcome = "finished";
};

/// The table of these runs.
Table runs_of(const OneRun& fit, const OneRun& test) {
  return Columns<OneRun>()
      .text("role", &OneRun::role)
      .text("outcome", &OneRun::outcome)
      .count("flights", &OneRun::flights)
      .count("wheel_flights", &OneRun::of_one_wheel)
      .table(std::vector{fit, test});
}

TEST(ScoreNotes, NameEstimatorsThatNeverReportFlightAndTheFlightsThatTheirFitLacks) {
  Experiment experiment;
  experiment.estimators = {"robust", "paper", "load_filter"};
  experiment.highlights = {{0.0, 0.0}};
  using Recall = std::pair<std::string, double>;
  const auto note = [&](const std::vector<Recall>& recalls, std::int64_t of_fit,
                        std::int64_t of_test) {
    ScoreTables tables{.runs = runs_of({"fit", 3, of_fit}, {"test", 1, of_test})};
    tables.cells.columns = {{"estimator"},
                            {.name = "torque_noise_nm", .type = ColumnType::exact},
                            {.name = "accelerometer_noise_mps2", .type = ColumnType::exact},
                            {.name = "no_contact_recall", .type = ColumnType::measured}};
    for (const auto& [estimator, recall] : recalls) {
      tables.cells.rows.push_back({estimator, 0.0, 0.0, recall});
    }
    return score_notes(experiment, tables);
  };
  EXPECT_EQ(note({{"robust", 0.6}, {"paper", NAN}}, 0, 2), "") << "found, or no flight at all";
  EXPECT_EQ(note({{"load_filter", 0.0}}, 0, 2), "") << "is not fitted";
  EXPECT_EQ(note({{"robust", 0.0}, {"paper", 0.01}}, 0, 2),
            "Bayes filter (robust), Bayes filter (paper) hardly ever report flight, so that they "
            "decide as always contact does. Their fit has no flight of one wheel alone, as the "
            "test has: add scenarios/push_off.yaml to fit.scenarios.");
  const std::string one =
      "Bayes filter (paper) hardly ever reports flight, so that it decides as always "
      "contact does.";
  EXPECT_EQ(note({{"paper", 0.0}}, 1, 2), one) << "the fit has them";
  EXPECT_EQ(note({{"paper", 0.0}}, 0, 0), one) << "the test has none";
}

/// Without noise it may be good.
TEST(ScoreNotes, NameTheSettingsInWhichAnEstimatorReportsNoFlight) {
  Experiment experiment;
  experiment.estimators = {"paper"};
  experiment.highlights = {{0.0, 0.0}, {1.0, 5.0}};
  ScoreTables tables;
  tables.cells.columns = {{"estimator"},
                          {"simulator"},
                          {.name = "torque_noise_nm", .type = ColumnType::exact},
                          {.name = "accelerometer_noise_mps2", .type = ColumnType::exact},
                          {.name = "no_contact_recall", .type = ColumnType::measured}};
  tables.cells.rows = {{"paper", "mujoco", 0.0, 0.0, 0.9},
                       {"paper", "bullet", 0.0, 0.0, 0.8},
                       {"paper", "mujoco", 1.0, 5.0, 0.3},
                       {"paper", "bullet", 1.0, 5.0, 0.01}};
  EXPECT_EQ(score_notes(experiment, tables),
            "Bayes filter (paper) (at torque noise 1 N·m, accelerometer noise 5 m/s² in Bullet) "
            "hardly ever reports flight, so that it decides as always contact does.");
}

TEST(ScoreNotes, NameATestWithoutAFlightAndEstimatorsThatAreFittedToItsScenes) {
  Experiment experiment;
  experiment.estimators = {"robust", "load_filter", "paper"};
  experiment.fit.scenarios = {"a.yaml", "b.yaml"};
  experiment.test.scenarios = {"c.yaml"};
  const auto note = [&](std::int64_t of_both, std::int64_t of_one, const std::string& outcome) {
    return score_notes(experiment,
                       {.runs = runs_of({"fit", 2, 0}, {"test", of_both, of_one, outcome})});
  };
  const std::string finished = "finished";
  const std::string none =
      "The test has no flight of a wheel: no takeoff can be missed, and to answer “contact” always "
      "is right.";
  EXPECT_EQ(note(0, 0, finished), none);
  EXPECT_EQ(note(1, 0, finished), "");
  EXPECT_EQ(note(0, 1, finished), "");
  EXPECT_EQ(note(0, 0, "fell"), "") << "no run is scored";
  experiment.test.scenarios = {"c.yaml", "b.yaml"};
  const std::string fitted =
      "Fitted to scenes of the test: Bayes filter (robust), Bayes filter (paper).";
  EXPECT_EQ(note(1, 0, finished), fitted);
  EXPECT_EQ(note(0, 0, finished), none + " " + fitted);
}

}  // namespace
}  // namespace touchdown::experiments
