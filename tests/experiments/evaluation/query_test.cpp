#include "experiments/evaluation/query.hpp"

#include <array>
#include <cmath>
#include <deque>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/rows.hpp"
#include "experiments/results/scores.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;

/// Ten runs with one flight each, and predictions of them.
class TenRuns {
 public:
  explicit TenRuns(const noise::NoiseCell& cell = {}) : cell_(cell), runs_(10) {}

  /// Adds a condition that decides `delay` steps late.
  TenRuns& delayed_by(const std::string& estimator, std::ptrdiff_t delay) {
    conditions_.push_back({"mujoco", "mujoco", estimator});
    for (std::size_t run = 0; run < runs_.size(); ++run) {
      const auto sequence = [&](std::ptrdiff_t shift) {
        scoring::ContactSequence contact(2000, 1);
        const auto takeoff = contact.begin() + 1000 + shift;
        std::fill(takeoff, takeoff + 100 + 10 * static_cast<std::ptrdiff_t>(run), 0);
        return contact;
      };
      const scoring::ContactSequence predicted = sequence(delay);
      scoring::Prediction prediction;
      prediction.fill({predicted, {predicted.begin(), predicted.end()}});
      const auto segments = scoring::score({sequence(0), sequence(0)}, prediction, {0}, 1000, {});
      rows_.scored.push_back({&runs_[run], 0, &conditions_.back(), &cell_, 0, segments.front()});
    }
    return *this;
  }
  /// Adds a condition of which no run was scored.
  TenRuns& unscored(const std::string& simulator) {
    conditions_.push_back({simulator, simulator, "robust"});
    rows_.scored.push_back({.condition = &conditions_.back(), .noise = &cell_});
    return *this;
  }
  ScoreTables tables() const { return score_tables(rows_, {.resamples = 50}); }

 private:
  noise::NoiseCell cell_;
  std::vector<PlannedRun> runs_;
  std::deque<Condition> conditions_;  // rows refer to them
  ScoreRows rows_;
};

TEST(ScoreTables, CoverEveryViewAndMetric) {
  const ScoreTables tables = TenRuns({0.25, 0.0}).delayed_by("robust", 12).tables();
  const std::vector<TableRow> scores = tables.scores.all();
  ASSERT_EQ(scores.size(), scoring::scored_views().size());
  for (const TableRow& row : scores) {
    EXPECT_EQ(row.number("takeoff_recall"), 1.0);
    EXPECT_DOUBLE_EQ(row.number("takeoff_latency_ms"), 12.0);
    EXPECT_NEAR(row.number("landing_latency_deviation_ms"), 0.0, 1e-9);
    // 88 of 100 to 178 of 190 steps: the runs differ in this, so its interval has a width.
    const Interval recall = row.interval("no_contact_recall");
    EXPECT_LT(recall.low, recall.high);
  }
  EXPECT_EQ(scores[0].text("view"), "wheels");
  EXPECT_EQ(scores[0].number("takeoffs"), 20.0);
  EXPECT_EQ(scores[1].number("takeoffs"), 10.0);
  // All of them were found, in every resample.
  EXPECT_NEAR(scores[0].interval("takeoff_recall").low, std::pow(0.025, 1.0 / 20.0), 1e-6);
  EXPECT_NEAR(scores[1].interval("takeoff_recall").low, std::pow(0.025, 1.0 / 10.0), 1e-6);
  EXPECT_EQ(tables.reliability.rows.size(), scores.size() * scoring::Calibration::bins);
}

/// Every event is found 12 ms late, in the bin that ends at 12.5 ms, or not at all.
TEST(ScoreTables, ListTheShareOfEventsFoundUpToEachLatency) {
  const Table table =
      TenRuns({0.25, 0.0}).delayed_by("robust", 12).delayed_by("paper", 600).tables().latencies;
  std::map<std::string, std::vector<std::array<double, 3>>> curves;
  for (const TableRow& row : table.all()) {
    if (row.text("view") != "wheels") continue;
    curves[row.text("estimator")].push_back(
        {row.number("latency_ms"), row.number("takeoffs_found"), row.number("landings_found")});
  }
  EXPECT_THAT(curves["robust"],
              ElementsAre(std::array{-27.5, 0.0, 0.0}, std::array{7.5, 0.0, 0.0},
                          std::array{12.5, 1.0, 1.0}, std::array{52.5, 1.0, 1.0}));
  EXPECT_THAT(curves["paper"],
              ElementsAre(std::array{-27.5, 0.0, 0.0}, std::array{52.5, 0.0, 0.0}));
}

TEST(ScoreTables, PairDifferencesByRun) {
  const ScoreTables tables = TenRuns().delayed_by("robust", 5).delayed_by("paper", 12).tables();
  const auto latency = where(tables.differences.all(), [](const TableRow& row) {
    return row.text("metric") == "takeoff_latency_ms";
  });
  ASSERT_EQ(latency.size(), 1U);
  EXPECT_EQ(latency[0].text("second"), "paper");
  // Every run has the same difference, however different the runs are.
  EXPECT_NEAR(latency[0].number("difference"), -7.0, 1e-9);
  EXPECT_NEAR(latency[0].interval("difference").low, -7.0, 1e-9);
  EXPECT_NEAR(latency[0].interval("difference").high, -7.0, 1e-9);
}

TEST(ScoreTables, KeepTheRowOfAConditionWithoutAScoredRun) {
  const ScoreTables tables = TenRuns().delayed_by("robust", 5).unscored("bullet").tables();
  const std::vector<TableRow> scores = tables.scores.all();
  ASSERT_EQ(scores.size(), 2 * scoring::scored_views().size());
  EXPECT_EQ(scores.back().text("simulator"), "bullet");
  EXPECT_TRUE(std::isnan(scores.back().number("event_f1")));
}

/// A count of events in a made-up run.
struct Count {
  double value = 0.0;
  Count& operator+=(const Count& other) {
    value += other.value;
    return *this;
  }
};

TEST(AQuery, HasALineForEachCombinationOfKeysAndASampleForEachRunAndSegment) {
  std::vector<PlannedRun> runs(3);
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i].simulator = i < 2 ? "mujoco" : "bullet";
  std::vector<Scored<Count>> rows;
  for (const PlannedRun& run : runs) {
    for (const std::size_t segment : {0U, 1U}) {
      for (const double value : {1.0, 10.0}) {  // two items of one sample
        Scored<Count> row{.run = &run, .segment = segment};
        row.score.value = value;
        rows.push_back(row);
      }
    }
  }
  Query<Count> query;
  query.by.text("engine", [](const Scored<Count>& row) { return row.run->simulator; });
  query.statistics = {{"sum", [](const Count& all) { return all.value; }}};
  query.totals.metric("double", [](const Count& all) { return 2.0 * all.value; });
  query.runs = "samples";
  const Answer<Count> found = answer(rows, query, {.resamples = 20});
  EXPECT_EQ(to_csv(found.table),
            "engine,sum,sum_low,sum_high,double,samples\n"
            "mujoco,44.000000,44.000000,44.000000,88.000000,4\n"
            "bullet,22.000000,22.000000,22.000000,44.000000,2\n");
  EXPECT_EQ(found.totals[1].value, 22.0);
}

TEST(AQuery, SubtractsOtherRowsOnTheSameRuns) {
  std::vector<PlannedRun> runs(4);
  const Condition high{"a", "a", "high"}, low{"a", "a", "low"};
  std::vector<Scored<Count>> rows;
  for (const Condition* condition : {&high, &low}) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      Scored<Count> row{.run = &runs[i], .condition = condition};
      row.score.value = 10.0 * static_cast<double>(i * i) + (condition == &high ? 3.0 : 0.0);
      rows.push_back(row);
    }
  }
  Query<Count> query;
  query.by.text("estimator", [](const Scored<Count>& row) { return row.condition->estimator; });
  const auto is_low = [&](const Scored<Count>& /*line*/, const Scored<Count>& other) {
    return other.condition == &low;
  };
  const auto sum = [](const Count& all) { return all.value; };
  query.differences = {{"gain", sum, is_low}, {"loss", sum, is_low, true}};
  // However different the runs are: a resample draws the same four of both.
  EXPECT_EQ(to_csv(answer(rows, query, {.resamples = 20}).table),
            "estimator,gain,gain_low,gain_high,loss,loss_low,loss_high\n"
            "high,12.000000,12.000000,12.000000,-12.000000,-12.000000,-12.000000\n"
            "low,0.000000,0.000000,0.000000,0.000000,0.000000,0.000000\n");
}

}  // namespace
}  // namespace touchdown::experiments
