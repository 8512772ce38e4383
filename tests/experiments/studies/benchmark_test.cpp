#include "experiments/studies/benchmark.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/table.hpp"
#include "experiments/experiment_context.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "tests/experiments/studies/study_test.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

/// A filter in a scene that it is fitted to and one in which nothing happens.
Experiment with_benchmark(const ScratchFolder& folder, const std::string& benchmark) {
  const std::string step = folder.write("small_step.yaml", small_step_scene).string();
  const std::string stand =
      folder.write("stand.yaml", "name: stand\nend: {duration: 1.0}\nperturbation: {yaw: 0.05}\n")
          .string();
  return experiment_from_yaml(YamlDocument::parse(
      "name: small\nsimulators: [mujoco]\nestimators: [measurement_only]\nfit: {scenarios: [" +
          step + "], runs: 2, perturbed: true}\ntest: {scenarios: [" + step + ", " + stand +
          "], runs: 2}\nnoise: {torque: [0, 1]}\nhighlights: [{torque: 0, accelerometer: 0}, "
          "{torque: 1, accelerometer: 0}]\nrecordings: none\nvideo: {enabled: false}\n"
          "benchmark: " +
          benchmark + "\n",
      "small.yaml"));
}

class Benchmark : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new ScratchFolder;
    RunOptions options;
    options.out = *folder / "run";
    result = new ExperimentResult(
        run_experiment(with_benchmark(*folder,
                                      "{robots: [models/upkie_actuated.yaml], sensors: "
                                      "[noise/profiles/harsh.yaml]}"),
                       options));
    table = table_of(from_csv(read_file(*folder / "run/tables/benchmark.csv")));
  }
  static void TearDownTestSuite() {
    delete result;
    delete folder;
  }

  static ScratchFolder* folder;
  static ExperimentResult* result;
  static Table table;
};
ScratchFolder* Benchmark::folder = nullptr;
ExperimentResult* Benchmark::result = nullptr;
Table Benchmark::table;

TEST_F(Benchmark, HasARowForEverySceneRobotSensorsNoiseAndEstimator) {
  EXPECT_THAT(
      texts_of(table).header,
      IsSupersetOf(
          {"simulator", "robot", "sensors", "scene", "split", "estimator", "balanced_accuracy",
           "balanced_accuracy_low", "balanced_accuracy_high", "no_contact_precision",
           "no_contact_recall", "event_f1", "long_errors_s_per_minute", "takeoff_latency_median_ms",
           "landing_latency_median_ms", "extra_switches_per_minute", "calibration_error"}));
  // Two robots, two kinds of sensors, two scenes, two noise settings, the filter and always
  // contact.
  ASSERT_EQ(table.rows.size(), 2U * 2 * 2 * 2 * 2);
  std::set<std::string> settings;
  for (const TableRow& row : table.all()) {
    settings.insert(row.text("robot") + " " + row.text("sensors"));
    const bool is_fitted = row.text("scene") == "small_step";
    EXPECT_EQ(row.text("split"), is_fitted ? "test" : "unseen");
    EXPECT_EQ(row.text("runs"), "2");
    EXPECT_EQ(row.text("failed"), "0");
  }
  EXPECT_EQ(settings, (std::set<std::string>{"upkie ideal", "upkie harsh", "upkie_actuated ideal",
                                             "upkie_actuated harsh"}));
}

TEST_F(Benchmark, HasScoresForEveryScene) {
  // There are no takeoffs on level ground, so that accuracy is that of contact alone.
  for (const TableRow& row : table.all()) {
    const bool stands = row.text("scene") == "stand";
    EXPECT_EQ(row.text("takeoffs") == "0", stands);
    if (stands) {
      EXPECT_EQ(row.text("balanced_accuracy"), row.text("success"));
    }
    if (row.text("estimator") != "always_contact") continue;
    EXPECT_EQ(row.text("balanced_accuracy"), stands ? "1.000000" : "0.500000");
    EXPECT_EQ(row.text("extra_switches_per_minute"), "0.000000");
  }
}

TEST_F(Benchmark, FitsToEveryRobotAndItsSensors) {
  for (const char* fit : {"", "_upkie_harsh", "_upkie_actuated_ideal", "_upkie_actuated_harsh"}) {
    ASSERT_TRUE(result->models.contains(std::string("mujoco") + fit)) << fit;
  }
  const auto density = [&](const std::string& fit) {
    return result->models.at("mujoco" + fit).at("measurement_only").grid->grids().contact;
  };
  EXPECT_NE(density(""), density("_upkie_harsh"));
  EXPECT_NE(density("_upkie_harsh"), density("_upkie_actuated_harsh"));
}

TEST(ABenchmark, ScoresTransfersBesideInDomainFits) {
  const ScratchFolder folder;
  Experiment experiment =
      with_benchmark(folder, "{robots: [models/upkie_actuated.yaml], transfer: true}");
  experiment.simulators = {"mujoco", "bullet"};
  experiment.highlights.resize(1);
  const ExperimentResult result = run_in(folder, experiment);
  const Table all = result.directory.read_table("benchmark.csv");
  std::map<std::string, int> fits;
  for (const TableRow& row : all.all()) {
    if (row.text("estimator") == "measurement_only") ++fits[row.text("fitted_on")];
  }
  // Two engines, two robots and two scenes; each from its own, from the other robot and engine.
  EXPECT_EQ(fits, (std::map<std::string, int>{{"own", 8},
                                              {"mujoco", 4},
                                              {"bullet", 4},
                                              {"upkie ideal", 4},
                                              {"upkie_actuated ideal", 4}}));
  // The experiment's own tables hold in-domain fits alone.
  EXPECT_EQ(result.tables.scores.rows.size(), 2U * 2 * scoring::scored_views().size());
}

TEST(ABenchmark, ResamplesFitsAndRunsTogether) {
  const ScratchFolder folder;
  const auto table_of = [&](const std::string& benchmark, const char* out) {
    return run_in(folder, with_benchmark(folder, benchmark), out)
        .directory.read_table("benchmark.csv");
  };
  const std::string robots = "{robots: [models/upkie_actuated.yaml]";
  const Table once = table_of(robots + "}", "once");
  const Table own = table_of(robots + ", refits: 3}", "own");
  const Table all = table_of(robots + ", refits: 2, refits_everywhere: true}", "all");
  ASSERT_EQ(own.rows.size(), once.rows.size());
  int wider = 0;
  for (std::size_t row = 0; row < own.rows.size(); ++row) {
    const auto of = [&](const Table& table, const char* column) {
      return TableRow(table, row).text(column);
    };
    const bool is_fitted = of(own, "estimator") == "measurement_only";
    const bool is_own = of(own, "robot") == "upkie";
    EXPECT_EQ(of(once, "refits"), "0");
    EXPECT_EQ(of(own, "refits"), is_fitted && is_own ? "3" : "0");
    EXPECT_EQ(of(all, "refits"), is_fitted ? "2" : "0");
    // What is scored is the fit to all runs.
    for (const char* column : {"balanced_accuracy", "event_f1", "log_loss"}) {
      EXPECT_EQ(of(own, column), of(once, column)) << column;
    }
    const auto width = [&](const Table& table) {
      return std::stod(of(table, "balanced_accuracy_high")) -
             std::stod(of(table, "balanced_accuracy_low"));
    };
    if (!(is_fitted && is_own)) {
      EXPECT_EQ(width(own), width(once));
    } else if (width(own) > width(once)) {
      ++wider;
    }
  }
  EXPECT_GT(wider, 0);
  for (const auto& file : std::filesystem::directory_iterator(folder / "own" / "models")) {
    EXPECT_EQ(file.path().string().find('~'), std::string::npos) << file.path();
  }
  EXPECT_THAT(own_files(folder / "own"),
              IsSupersetOf({std::filesystem::path("tables") / "benchmark_standings.csv",
                            std::filesystem::path("tables") / "benchmark_differences.csv"}));
}

TEST(ABenchmark, SimulatesARobotOnceForAllItsSensors) {
  const ScratchFolder folder;
  const RunRequest request =
      request_of(with_benchmark(folder, "{sensors: [noise/profiles/harsh.yaml]}"));
  const Plan plan = whole_plan(request);
  const auto harsh = benchmark_setups(request, plan).at(1);
  const auto own = plan.runs_in(0);
  const auto reported = plan.runs_in(harsh.group);
  ASSERT_EQ(own.size(), reported.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    EXPECT_EQ(plan.runs[own[i]].file, plan.runs[reported[i]].file);
    EXPECT_NE(plan.runs[own[i]].sensors, plan.runs[reported[i]].sensors);
  }
}

/// The text of a run's table.
std::string table_text(const std::filesystem::path& run, const std::string& name) {
  return read_file(run / "tables" / name);
}

TEST(ABenchmark, RefitsInAShardOfOneEngineAreThoseOfTheWholeRun) {
  const ScratchFolder folder;
  Experiment experiment = with_benchmark(folder, "{refits: 2}");
  experiment.simulators = {"mujoco", "bullet"};
  (void)run_experiment(experiment, {.out = folder / "whole", .command = "test"});
  for (int shard = 1; shard <= 4; ++shard) {  // two of each engine
    (void)run_shard(experiment, {shard, 4}, {.out = folder / "parts", .command = "test"});
  }
  (void)finish_run(folder / "parts", {.out = {}, .command = "test"});
  const std::string expected = table_text(folder / "whole", "benchmark.csv");
  EXPECT_THAT(expected, HasSubstr("bullet"));
  EXPECT_EQ(table_text(folder / "parts", "benchmark.csv"), expected);
}

TEST(ABenchmark, ContinuesAndMergesWithoutSignalsInMemory) {
  const ScratchFolder folder;
  const Experiment experiment = with_benchmark(folder, "{robots: [models/upkie_heavy.yaml]}");
  const auto options = [&](const char* name) {
    return RunOptions{.out = folder / name, .command = "test"};
  };
  (void)run_experiment(experiment, options("whole"));
  EXPECT_GT(run_shard(experiment, {1, 3}, options("parts")).computed, 0U);
  EXPECT_EQ(run_shard(experiment, {1, 3}, options("parts")).computed, 0U);
  (void)run_shard(experiment, {2, 3}, options("parts"));
  (void)run_shard(experiment, {3, 3}, options("parts"));
  (void)finish_run(folder / "parts", options("parts"));
  for (const char* name : {"benchmark.csv", "success.csv", "runs.csv"}) {
    EXPECT_EQ(table_text(folder / "parts", name), table_text(folder / "whole", name)) << name;
  }
}

TEST(ABenchmark, UsesEveryRobotsOwnPostureAndBalancer) {
  const ScratchFolder folder;
  const RunRequest request =
      request_of(with_benchmark(folder, "{robots: [models/upkie_straight.yaml]}"));
  const Plan plan = whole_plan(request);
  const auto straight = benchmark_setups(request, plan).at(1);
  const scenarios::Scenario& own = plan.runs[plan.runs_in(0).front()].scenario;
  const scenarios::Scenario& other = plan.runs[plan.runs_in(straight.group).front()].scenario;
  EXPECT_LT(other.start.hip, 0.5 * own.start.hip);
  EXPECT_NE(other.balancer.pitch_damping, own.balancer.pitch_damping);
  EXPECT_EQ(other.terrain.pieces.size(), own.terrain.pieces.size());
  // The request reads back as written.
  const std::filesystem::path run = folder / "run";
  write_request(request, RunDirectory("small", request.id, run), false);
  EXPECT_EQ(read_request(run).id, request.id);
}

TEST(ABenchmark, CountsTheContentOfItsRobotsAndSensors) {
  const ScratchFolder folder;
  const std::string mine = folder.write("mine.yaml", "torque: {white: 0.1}\n").string();
  const auto id = [&] {
    return request_of(with_benchmark(folder, "{sensors: [" + mine + "]}")).id;
  };
  const std::string first = id();
  folder.write("mine.yaml", "torque: {white: 0.2}\n");
  EXPECT_NE(id(), first);
  const std::string robot =
      folder.write("mine_too.yaml", "mjcf: " TOUCHDOWN_SOURCE_DIR "/models/upkie.xml\n").string();
  const auto of_robot = [&] {
    return request_of(with_benchmark(folder, "{robots: [" + robot + "]}")).id;
  };
  const std::string before = of_robot();
  folder.write("mine_too.yaml", "mjcf: " TOUCHDOWN_SOURCE_DIR
                                "/models/upkie.xml\nactuators: {knee: {friction: 0.1}}\n");
  EXPECT_NE(of_robot(), before);
}

}  // namespace
}  // namespace touchdown::experiments
