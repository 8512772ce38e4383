#include "experiments/results/long_table.hpp"

#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/results/scores.hpp"
#include "experiments/run_directory/directory.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_experiment.hpp"
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

/// A line of `results.csv` by its columns.
using LongRow = std::map<std::string, std::string>;

std::vector<LongRow> rows_of(const Columns<Row>& described, const Row& row) {
  const Table table = described.table(std::vector{row});
  std::vector<LongRow> rows;
  for (const auto& cells : long_rows("survival", table, 0, {"upkie", "ideal"})) {
    LongRow& found = rows.emplace_back();
    for (std::size_t i = 0; i < cells.size(); ++i) found[long_header.at(i)] = cells[i];
  }
  return rows;
}

TEST(LongRows, HoldOneNumberEach) {
  const auto rows =
      rows_of(columns(), {"stairs", "truth", "", {1.0, 5.0}, 0.7, {0.9, 0.8, 1.0}, 20.0, 40});
  ASSERT_EQ(rows.size(), 2U);
  LongRow expected = {{"study", "survival"}, {"simulator", ""},        {"robot", "upkie"},
                      {"sensors", "ideal"},  {"scene", "stairs"},      {"estimator", "truth"},
                      {"unit", ""},          {"metric", "accuracy"},   {"noise", "1 N·m, 5 m/s²"},
                      {"n", "40"},           {"estimate", "0.900000"}, {"low", "0.800000"},
                      {"high", "1.000000"},  {"setting", "value=0.7"}};
  EXPECT_EQ(rows[0], expected);
  expected["metric"] = "latency_ms";
  expected["unit"] = "ms";
  expected["estimate"] = "20.000000";
  expected["low"] = expected["high"] = "";
  EXPECT_EQ(rows[1], expected);
}

TEST(LongRows, NameTheMetricThatAKeyNames) {
  const auto described =
      Columns<Row>().text("metric", &Row::metric).metric("difference", &Row::latency);
  const auto rows = rows_of(described, {.metric = "takeoff_latency_ms", .latency = 3.0});
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].at("metric"), "difference_of_takeoff_latency_ms");
  EXPECT_EQ(rows[0].at("unit"), "ms");
  EXPECT_EQ(rows[0].at("setting"), "");
}

TEST(LongRows, NameSeparateLevelsOfKneesAndWheels) {
  const auto described = Columns<Row>()
                             .part(&Row::noise, noise_columns())
                             .part(&Row::noise, knee_wheel_columns())
                             .metric("success", &Row::latency);
  EXPECT_EQ(
      rows_of(described, {.noise = noise::knee_wheel_cell(0.5, 0.1, 2.0)}).front().at("noise"),
      "knee 0.5 N·m, wheel 0.1 N·m, 2 m/s²");
  EXPECT_EQ(rows_of(described, {.noise = {1.0, 5.0}}).front().at("noise"), "1 N·m, 5 m/s²");
  EXPECT_EQ(rows_of(described, {.noise = {1.0, 5.0}}).front().at("setting"), "");
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
  EXPECT_EQ(unit_of("extra_switches_per_minute"), "1/min");
  EXPECT_EQ(unit_of("long_errors_s_per_minute"), "s/min");
  EXPECT_EQ(unit_of("takeoffs"), "");
}

TEST(Tables, AreReadAsTheyWereWrittenAlsoByAnotherProcess) {
  const ScratchFolder folder;
  const std::vector<Row> rows = {
      {"stairs", "truth", "", {1.0, 5.0}, 0.7, {0.9, 0.8, 1.0}, 20.0, 40}};
  const RunDirectory writer("a", "b", folder.path());
  writer.write_table("a.csv", columns(), rows);
  writer.write_table("b.csv", columns().table(rows));  // is not measured
  const RunDirectory reader("a", "b", folder.path());
  for (const RunDirectory& directory : {writer, reader}) {
    const Table& read = directory.read_table("a.csv");
    EXPECT_EQ(read.rows, columns().table(rows).rows);
    EXPECT_EQ(read.columns, columns().list());
    EXPECT_EQ(to_csv(directory.read_table("b.csv")), to_csv(read));
    EXPECT_THAT(directory.store().names(column_parts), ElementsAre("a.csv"));
  }
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
            "name: small\nestimators: [load_filter, robust]\nfit: {scenarios: [" + step +
                "]}\ntest: {scenarios: [" + step +
                "], runs: 2}\nnoise: {torque: [0, 1]}\nhighlights: [{torque: 0, accelerometer: 0}, "
                "{torque: 1, accelerometer: 0}]\nrecordings: none\nvideo: {enabled: false}\n"
                "benchmark: {robots: [models/upkie_actuated.yaml], sensors: "
                "[noise/profiles/harsh.yaml]}\nmoments: true\n"
                "odometry: {}\nclosed_loop: {runs: 1, contact: [truth, load_filter], scenes: "
                "[{scenario: " +
                step + ", key: terrain.pieces.1.step.drop, values: [0.1, 0.2]}]}\n",
            "small.yaml")),
        options);
    results = table("results.csv");
  }
  static void TearDownTestSuite() { delete folder; }

  static TextTable table(const std::string& name) {
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
  static TextTable results;
};
ScratchFolder* Results::folder = nullptr;
TextTable Results::results;

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
                                     "moments", "odometry", "survival"}));
  EXPECT_THAT(own_files(*folder / "run"), Contains(std::filesystem::path("tables/results.csv")));
  EXPECT_THAT(own_files(*folder / "run"),
              Contains(std::filesystem::path("state/columns/survival.csv")));
}

TEST_F(Results, HaveTheNumbersOfTheBenchmark) {
  const auto found = numbers("benchmark", {"simulator", "robot", "sensors", "estimator", "noise"});
  const TextTable wide = table("benchmark.csv");
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

TEST_F(Results, TakeRobotAndSensorsFromTheExperimentWhereATableHasNone) {
  for (const std::vector<std::string>& row : results.rows) {
    if (cell(results, row, "study") != "success") continue;
    EXPECT_EQ(cell(results, row, "robot"), "upkie");
    EXPECT_EQ(cell(results, row, "sensors"), "ideal");
  }
}

}  // namespace
}  // namespace touchdown::experiments
