#include "experiments/tables/results.hpp"

#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "experiments/run_directory/directory.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_experiment.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "experiments/tables/noise_columns.hpp"
#include "tests/experiments/small_step_scene.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsSupersetOf;

struct Row {
  std::string scene = {};
  std::string contact = {};
  std::string metric = {};
  noise::NoiseCell noise = {};
  double value = 0.0;
  Interval accuracy = {};
  double latency = 0.0;
  int runs = 0;
};

Columns<Row> columns() {
  return Columns<Row>()
      .text("scenario", &Row::scene)
      .as("scene")
      .text("contact", &Row::contact)
      .as("estimator")
      .part(&Row::noise, noise_columns())
      .level("value", &Row::value)
      .interval("accuracy", &Row::accuracy)
      .metric("latency_ms", &Row::latency)
      .runs("runs", &Row::runs)
      .text("remark", &Row::scene)
      .is(ColumnRole::note);
}

std::vector<ResultRow> rows_of(const Columns<Row>& described, const Row& row) {
  return long_rows("survival", described.table(std::vector{row}), described.infos(),
                   {"upkie", "ideal"});
}

TEST(LongRows, HoldOneNumberEach) {
  const auto rows =
      rows_of(columns(), {"stairs", "truth", "", {1.0, 5.0}, 0.7, {0.9, 0.8, 1.0}, 20.0, 40});
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].study, "survival");
  EXPECT_EQ(rows[0].simulator, "");
  EXPECT_EQ(rows[0].robot, "upkie");
  EXPECT_EQ(rows[0].sensors, "ideal");
  EXPECT_EQ(rows[0].scene, "stairs");
  EXPECT_EQ(rows[0].estimator, "truth");
  EXPECT_EQ(rows[0].noise, "1 N·m, 5 m/s²");
  EXPECT_EQ(rows[0].metric, "accuracy");
  EXPECT_EQ(rows[0].unit, "");
  EXPECT_EQ(rows[0].n, "40");
  EXPECT_EQ(rows[0].estimate, "0.900000");
  EXPECT_EQ(rows[0].low, "0.800000");
  EXPECT_EQ(rows[0].high, "1.000000");
  EXPECT_EQ(rows[0].setting, "value=0.7");
  EXPECT_EQ(rows[1].metric, "latency_ms");
  EXPECT_EQ(rows[1].unit, "ms");
  EXPECT_EQ(rows[1].estimate, "20.000000");
  EXPECT_EQ(rows[1].low, "");
  EXPECT_EQ(rows[1].high, "");
}

TEST(LongRows, NameTheMetricThatAKeyNames) {
  const auto described =
      Columns<Row>().text("metric", &Row::metric).metric("difference", &Row::latency);
  const auto rows = rows_of(described, {.metric = "takeoff_latency_ms", .latency = 3.0});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].metric, "difference_of_takeoff_latency_ms");
  EXPECT_EQ(rows[0].unit, "ms");
  EXPECT_EQ(rows[0].setting, "");
}

TEST(LongRows, NameSeparateLevelsOfKneesAndWheels) {
  const auto described = Columns<Row>()
                             .part(&Row::noise, noise_columns())
                             .part(&Row::noise, knee_wheel_columns())
                             .metric("success", &Row::latency);
  EXPECT_EQ(rows_of(described, {.noise = noise::knee_wheel_cell(0.5, 0.1, 2.0)}).front().noise,
            "knee 0.5 N·m, wheel 0.1 N·m, 2 m/s²");
  EXPECT_EQ(rows_of(described, {.noise = {1.0, 5.0}}).front().noise, "1 N·m, 5 m/s²");
  EXPECT_EQ(rows_of(described, {.noise = {1.0, 5.0}}).front().setting, "");
}

TEST(Units, FollowFromTheEndOfAName) {
  EXPECT_EQ(unit_of("takeoff_latency_ms"), "ms");
  EXPECT_EQ(unit_of("landing_speed_rms_mps"), "m/s");
  EXPECT_EQ(unit_of("distance_m"), "m");
  EXPECT_EQ(unit_of("largest_pitch_rad"), "rad");
  EXPECT_EQ(unit_of("largest_force_n"), "N");
  EXPECT_EQ(unit_of("wasserstein_nm"), "N·m");
  EXPECT_EQ(unit_of("density_per_nm"), "1/(N·m)");
  EXPECT_EQ(unit_of("false_takeoffs_per_minute"), "1/min");
  EXPECT_EQ(unit_of("balanced_accuracy"), "");
  EXPECT_EQ(unit_of("takeoffs"), "");
}

TEST(SavedColumns, AreReadBack) {
  const ScratchFolder folder;
  const Store store(folder.path(), "key");
  store.put("columns", "a.csv", columns().infos());
  const auto read = store.find<std::vector<ColumnInfo>>("columns", "a.csv");
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(pack(*read), pack(columns().infos()));
}

/// An experiment with most studies, and its tables.
class Results : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new ScratchFolder;
    const std::string step = folder->write("small_step.yaml", small_step_scene).string();
    RunOptions options;
    options.out = *folder / "run";
    run_experiment(
        experiment_from_yaml(YamlDocument::parse(
            "name: small\nestimators: [support_force, robust]\nfit: {scenarios: [" + step +
                "]}\ntest: {scenarios: [" + step +
                "], runs: 2}\nnoise: {torque: [0, 1]}\nhighlights: [{torque: 0, accelerometer: 0}, "
                "{torque: 1, accelerometer: 0}]\nrecordings: none\nvideo: {enabled: false}\n"
                "benchmark: {robots: [models/upkie_actuated.yaml], sensors: "
                "[sensors/harsh.yaml]}\nmoments: true\n"
                "odometry: {}\noperating_points: {}\nclosed_loop: {runs: 1, contact: [truth, "
                "support_force], scenes: [{scenario: " +
                step + ", key: terrain.pieces.1.step.drop, values: [0.1, 0.2]}]}\n",
            "small.yaml")),
        options);
    results = table("results.csv");
  }
  static void TearDownTestSuite() { delete folder; }

  static Table table(const std::string& name) {
    return from_csv(read_file(*folder / ("run/tables/" + name)));
  }

  /// The numbers of one study in `results.csv`, by column of the wide table and these columns.
  static std::map<std::vector<std::string>, std::string> numbers(
      const std::string& study, const std::vector<std::string>& keys) {
    std::map<std::vector<std::string>, std::string> found;
    for (const std::vector<std::string>& row : results.rows) {
      if (cell(results, row, "study") != study) continue;
      std::vector<std::string> key = {cell(results, row, "metric")};
      for (const std::string& name : keys) key.push_back(cell(results, row, name));
      EXPECT_TRUE(found.emplace(key, cell(results, row, "estimate")).second);
    }
    return found;
  }

  static ScratchFolder* folder;
  static Table results;
};
ScratchFolder* Results::folder = nullptr;
Table Results::results;

TEST_F(Results, HaveOneRowPerNumberOfEveryTable) {
  EXPECT_THAT(results.header,
              ElementsAre("study", "simulator", "robot", "sensors", "scene", "estimator", "noise",
                          "metric", "unit", "n", "estimate", "low", "high", "setting"));
  std::set<std::string> studies;
  std::set<std::vector<std::string>> settings;
  for (const std::vector<std::string>& row : results.rows) {
    studies.insert(cell(results, row, "study"));
    std::vector<std::string> setting(row.begin(), row.begin() + 8);
    setting.push_back(cell(results, row, "setting"));
    EXPECT_TRUE(settings.insert(setting).second) << ::testing::PrintToString(row);
  }
  EXPECT_THAT(studies, IsSupersetOf({"benchmark", "benchmark_standings", "success", "views",
                                     "moments", "odometry", "operating_points", "survival"}));
  EXPECT_THAT(own_files(*folder / "run"), Contains(std::filesystem::path("tables/results.csv")));
  EXPECT_THAT(own_files(*folder / "run"),
              Contains(std::filesystem::path("state/columns/survival.csv")));
}

TEST_F(Results, HaveTheNumbersOfTheBenchmark) {
  const auto found = numbers("benchmark", {"simulator", "robot", "sensors", "estimator", "noise"});
  const Table wide = table("benchmark.csv");
  ASSERT_EQ(wide.rows.size(), 2U * 2 * 2 * 3 * 2);  // engines, robots, sensors, estimators, noise
  for (const std::vector<std::string>& row : wide.rows) {
    const std::string noise = cell(wide, row, "torque_noise_nm") + " N·m, 0 m/s²";
    for (const char* metric : {"balanced_accuracy", "takeoff_latency_median_ms", "takeoffs"}) {
      EXPECT_EQ(found.at({metric, cell(wide, row, "simulator"), cell(wide, row, "robot"),
                          cell(wide, row, "sensors"), cell(wide, row, "estimator"), noise}),
                cell(wide, row, metric));
    }
  }
}

TEST_F(Results, HaveTheNumbersOfTheClosedLoop) {
  const auto found = numbers("survival", {"simulator", "estimator", "n", "setting"});
  const Table wide = table("survival.csv");
  ASSERT_EQ(wide.rows.size(), 2U * 2 * 2);  // engines, contact sources, heights
  for (const std::vector<std::string>& row : wide.rows) {
    const std::string setting =
        "policy=soft_landing; varied=drop; key=terrain.pieces.1.step.drop; "
        "value=" +
        cell(wide, row, "value") + "; delay_ms=0";
    for (const char* metric : {"finished", "landings", "largest_force_n"}) {
      EXPECT_EQ(found.at({metric, cell(wide, row, "simulator"), cell(wide, row, "contact"), "1",
                          setting}),
                cell(wide, row, metric));
    }
  }
}

TEST_F(Results, TakeRobotAndSensorsFromTheExperimentWhereATableHasNone) {
  for (const std::vector<std::string>& row : results.rows) {
    if (cell(results, row, "study") != "success") continue;
    EXPECT_EQ(cell(results, row, "robot"), "upkie");
    EXPECT_EQ(cell(results, row, "sensors"), "ideal");
  }
}

}  // namespace
}  // namespace touchdown::experiments
