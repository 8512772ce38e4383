#include "experiments/studies/cross_simulator.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/columns.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/table.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/run_experiment.hpp"
#include "tests/experiments/small_step_scene.hpp"
#include "tests/experiments/studies/study_test.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A transfer of `robust`, by the ends of its intervals that a verdict judges.
struct Transfer {
  std::string fit, test;
  double loss_high, gain_low;
};

Verdict verdict_of(const std::vector<Transfer>& transfers) {
  Experiment experiment;
  experiment.studies.emplace<CrossSimulatorConfig>().verdict = {
      .largest_loss = 0.01, .smallest_gain = 0.0, .demanded = {"robust"}};
  const auto columns =
      Columns<Transfer>()
          .text("estimator", [](const Transfer& /*row*/) { return "robust"; })
          .text("fit_simulator", &Transfer::fit)
          .text("test_simulator", &Transfer::test)
          .interval("loss",
                    [](const Transfer& row) {
                      return Interval{row.loss_high - 0.002, row.loss_high - 0.004, row.loss_high};
                    })
          .interval("gain", [](const Transfer& row) {
            return Interval{row.gain_low + 0.01, row.gain_low, row.gain_low + 0.02};
          });
  const std::vector<Verdict> all = verdicts(columns.table(transfers), experiment);
  EXPECT_EQ(all.size(), 1U);
  return all.front();
}

TEST(Verdict, HoldsIfBothTransfersAreWithinTheLimitsByTheEndsOfTheirIntervals) {
  const double nan = std::nan("");
  struct Case {
    std::vector<Transfer> transfers;
    bool holds;
    const char* words;
  };
  for (const Case& one : {
           Case{{{"a", "b", 0.004, 0.05}, {"b", "a", 0.009, 0.08}}, true, "0.0090"},
           // The own engine does not matter.
           Case{{{"a", "a", 0.5, -0.5}, {"a", "b", 0.0, 0.1}}, true, "holds"},
           // The estimate of the loss is 0.009, below what is allowed; its upper end is not.
           Case{{{"a", "b", 0.011, 0.05}, {"b", "a", 0.0, 0.1}}, false, "too much"},
           Case{{{"a", "b", 0.0, -0.001}, {"b", "a", 0.0, 0.1}}, false, "FAILS"},
           Case{{{"a", "b", nan, 0.1}, {"b", "a", 0.0, 0.1}}, false, "FAILS"},
           Case{{{"a", "b", 0.0, 0.1}, {"b", "a", 0.0, nan}}, false, "FAILS"},
       }) {
    const Verdict verdict = verdict_of(one.transfers);
    EXPECT_EQ(verdict.holds, one.holds) << verdict.words;
    EXPECT_THAT(verdict.words, HasSubstr(one.words));
    EXPECT_EQ(failed_demands({verdict}).empty(), one.holds);
  }
}

TEST(Agreement, OfTwoEnginesThatDifferByAConstantIsThatConstant) {
  std::vector<RunFacts> first(6);
  std::vector<RunFacts> second(6);
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double duration = 150.0 + static_cast<double>(i);
    first[i].quantity[0].add(duration);
    second[i].quantity[0].add(duration + 4.0);
    first[i].torque[0] = second[i].torque[0] = scoring::Histogram(-1.0, 1.0, 200);
    first[i].torque[0].add(-0.205);
    second[i].torque[0].add(0.195);
  }
  const Agreement found = agreement(first, second, {});
  EXPECT_EQ(found.runs, 6U);
  EXPECT_DOUBLE_EQ(found.quantities[0].first.estimate, 152.5);
  // Paired: every resample has the same difference.
  EXPECT_NEAR(found.quantities[0].difference.low, 4.0, 1e-9);
  EXPECT_NEAR(found.quantities[0].difference.high, 4.0, 1e-9);
  EXPECT_LT(found.quantities[0].first.low, 152.5);
  EXPECT_NEAR(found.torques[0].distance.estimate, 0.4, 1e-9);
  EXPECT_DOUBLE_EQ(found.torques[0].overlap.estimate, 0.0);
  EXPECT_DOUBLE_EQ(found.torques[0].within_engine, 0.0);
  EXPECT_TRUE(std::isnan(found.torques[1].distance.estimate));
}

/// A hand-made run of one wheel pair: contact as given, one acceleration peak.
Rollout hand_made(const std::vector<std::pair<int, int>>& state_and_length, std::size_t peak_at) {
  Rollout run;
  run.signals.info.control_period_us = 1000;
  for (const auto& [state, length] : state_and_length) {
    for (auto& wheel : run.signals.contact) {
      wheel.insert(wheel.end(), static_cast<std::size_t>(length), static_cast<std::uint8_t>(state));
    }
  }
  run.signals.signals.resize(run.signals.contact[0].size());
  run.signals.signals[peak_at].vertical_acceleration = -123.0;
  run.report.duration = 9.0;
  run.plan.scenario.end.x = 5.0;
  run.plan.scenario.end.settle = 1.5;
  return run;
}

TEST(RunFacts, CountAnEdgeContactAfterTheNosingAndABounce) {
  // Off for 8 steps, an edge contact of 12, a drop of 150, contact 20, a bounce of 15, contact to
  // the end.
  const Rollout run =
      hand_made({{1, 500}, {0, 8}, {1, 12}, {0, 150}, {1, 20}, {0, 15}, {1, 295}}, 680);
  RunFacts facts = facts_of(run.signals, {});
  add_descent(run, facts);
  const auto value = [&](Quantity q) {
    return facts.quantity[static_cast<std::size_t>(q)].value();
  };
  EXPECT_DOUBLE_EQ(value(Quantity::flight_duration), 150.0);
  EXPECT_DOUBLE_EQ(value(Quantity::peak_acceleration), 123.0);
  EXPECT_DOUBLE_EQ(value(Quantity::edge_contacts), 1.0);
  EXPECT_DOUBLE_EQ(value(Quantity::bounces), 1.0);
  // 173 of the 700 steps after the first 300 are in the air.
  EXPECT_DOUBLE_EQ(value(Quantity::contact_ratio), 1.0 - 173.0 / 700.0);
  EXPECT_DOUBLE_EQ(value(Quantity::descent), 7.5);
}

const std::string small_check = R"(name: small_cross
estimators: [measurement_only]
fit: {scenarios: [SCENE]}
test: {scenarios: [SCENE], runs: 2}
noise: {torque: [0.25], accelerometer: [0.23]}
video: {enabled: false}
cross_simulator:
  verdict: {demanded: [measurement_only]}
  overlay: {drop: 0}
)";

class CrossSimulatorRun : public ::testing::Test {
 protected:
  CrossSimulatorRun() { folder_.write("small_step.yaml", small_step_scene); }

  Experiment read() const {
    const std::string scene = (folder_ / "small_step.yaml").string();
    return experiment_from_yaml(YamlDocument::parse(
        std::regex_replace(small_check, std::regex("SCENE"), scene), "small.yaml"));
  }

  const ScratchFolder folder_;
};

TEST_F(CrossSimulatorRun, ComparesTransfersAndJudges) {
  const ExperimentResult result = run_experiment(read(), {folder_ / "out", "", nullptr});
  const auto rows = [&](const char* table) {
    return from_csv(read_file(folder_ / "out/tables" / table)).rows;
  };
  ASSERT_EQ(rows("agreement.csv").size(), quantity_count);
  // From 0.2 m a wheel falls freely for a little less than sqrt(2 h / g) = 0.202 s.
  const double flight_ms = std::stod(rows("agreement.csv")[0][2]);
  EXPECT_GT(flight_ms, 100.0);
  EXPECT_LT(flight_ms, 203.0);
  // Two estimators (with always contact), two fit engines, two test engines.
  ASSERT_EQ(rows("transfer.csv").size(), 8U);
  for (const std::vector<std::string>& row : rows("transfer.csv")) {
    if (row[3] == row[4]) {
      EXPECT_EQ(std::stod(row[12]), 0.0);  // the loss
    }
    EXPECT_GT(std::stod(row[6]), 0.5);
  }
  ASSERT_EQ(rows("verdicts.csv").size(), 1U);
  EXPECT_EQ(rows("verdicts.csv")[0][2], "1");
  // The experiment's own tables hold in-domain fits alone.
  EXPECT_EQ(result.tables.cells.rows.size(), 4U);
  EXPECT_THAT(result.studies, ::testing::ElementsAre(HasSubstr("Verdicts")));
  ASSERT_EQ(result.figures.size(), 1U);
  EXPECT_EQ(result.figures[0].name, "transfer");
  ASSERT_EQ(result.figures[0].series.groups.size(), 2U);  // both directions
  EXPECT_THAT(result.figures[0].series.groups[0].values, ElementsAre("mujoco", "bullet"));
  EXPECT_THAT(result.figures[0].series.groups[1].values, ElementsAre("bullet", "mujoco"));
  EXPECT_EQ(result.figures[0].rows.groups.size(), 1U);  // always contact is not fitted
  for (const char* file :
       {"config.yaml", "manifest.json", "tables/agreement.csv", "tables/torques.csv",
        "tables/transfer.csv", "tables/verdicts.csv", "tables/cross_simulator.md"}) {
    EXPECT_TRUE(fs::exists(folder_ / "out" / file)) << file;
  }
}

}  // namespace
}  // namespace touchdown::experiments
