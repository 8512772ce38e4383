#include "experiments/studies/closed_loop.hpp"

#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/table.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/experiment_context.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_directory/shard.hpp"
#include "experiments/run_experiment.hpp"
#include "tests/experiments/small_step_scene.hpp"
#include "tests/experiments/studies/study_test.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Experiment with_closed_loop(const ScratchFolder& folder, const std::string& section,
                            const std::string& sensors = "noise/profiles/upkie.yaml",
                            const std::string& estimators = "[load_filter, robust]") {
  const std::string step = folder.write("small_step.yaml", small_step_scene).string();
  return experiment_from_yaml(
      YamlDocument::parse("name: small\nestimators: " + estimators + "\nsensors: " + sensors +
                              "\nfit: {scenarios: [" + step + "]}\ntest: {scenarios: [" + step +
                              "], runs: 1}\nrecordings: none\nvideo: {enabled: false}\n" + section,
                          "small.yaml"));
}

std::string of_steps(const ScratchFolder& folder, const std::string& scene) {
  return "closed_loop:\n  runs: 2\n  scenes: [{scenario: " + (folder / "small_step.yaml").string() +
         scene + "}]\n";
}

const char* const two_heights = ", key: terrain.pieces.1.step.drop, values: [0.1, 0.3]";

TEST(ClosedLoop, CountsFinishedRunsForEveryContactSourceAndPoint) {
  const ScratchFolder folder;
  const ExperimentResult result =
      run_in(folder, with_closed_loop(folder, of_steps(folder, two_heights)));
  const Table table = result.directory.read_table("survival.csv");
  const std::vector<std::string> header = texts_of(table).header;
  ASSERT_GE(header.size(), 9U);
  EXPECT_THAT(std::vector<std::string>(header.begin(), header.begin() + 9),
              ElementsAre("simulator", "scenario", "policy", "contact", "rise_m", "runs",
                          "finished", "finished_low", "finished_high"));
  ASSERT_EQ(table.rows.size(), 2U * 4U * 2U);  // engines, contact sources, heights
  std::vector<std::string> contacts;
  for (const TableRow& row : table.all()) {
    const auto number = [&](const char* column) { return row.number(column); };
    if (contacts.size() < 4 && number("value") == 0.1) contacts.push_back(row.text("contact"));
    EXPECT_EQ(row.text("policy"), "soft_landing");
    EXPECT_EQ(row.text("is_oracle"), row.text("contact") == "truth" ? "1" : "0");
    EXPECT_EQ(number("finished"), 1.0) << "a drop of 0.3 m is no danger";
    EXPECT_NEAR(number("finished_low"), 0.1581, 1e-4);  // of two runs
    EXPECT_EQ(number("landings"), 4.0);
    EXPECT_GT(number("largest_force_n"), 100.0);
  }
  EXPECT_THAT(contacts, ElementsAre("truth", "always", "load_filter", "robust"));
  EXPECT_THAT(result.studies.back(), AllOf(HasSubstr("Truth (oracle)"), HasSubstr("drop 0.3")));
  EXPECT_THAT(own_files(folder / "run"), Contains(std::filesystem::path("tables/survival.csv")));
  EXPECT_THAT(own_files(folder / "run"),
              Contains(std::filesystem::path("state/closed_loop/run_000000")));
}

TEST(ClosedLoop, HasAFigureForEverySceneAndVariedQuantity) {
  const ScratchFolder folder;
  const std::string step = (folder / "small_step.yaml").string();
  Experiment experiment = with_closed_loop(
      folder,
      "closed_loop:\n  runs: 1\n  contact: [truth, load_filter]\n  scenes:\n    - {scenario: " +
          step + two_heights + "}\n    - {scenario: " + step +
          ", delay: [0, 0.02]}\n    - {scenario: " + step + "}\n");
  experiment.simulators = {"mujoco"};
  const std::vector<FigureSpec> figures = run_in(folder, experiment).figures;
  ASSERT_EQ(figures.size(), 3U);
  EXPECT_EQ(figures[0].name, "survival_small_step_soft_landing_drop");
  ASSERT_EQ(figures[0].series.groups.size(), 2U);
  EXPECT_EQ(figures[0].series.groups[0].title, "Truth (oracle)");
  EXPECT_EQ(figures[0].colour_order, experiment.estimators);
  EXPECT_EQ(figures[0].x.column, "value");
  EXPECT_THAT(figures[0].caption, HasSubstr("1 runs per point"));
  EXPECT_THAT(figures[0].alt, HasSubstr("MuJoCo, Truth (oracle): 1 at 0.1"));
  EXPECT_EQ(figures[1].x.column, "delay_ms");
  EXPECT_EQ(figures[1].x.unit, "ms");
  EXPECT_EQ(figures[2].name, "survival_small_step_soft_landing");
  EXPECT_EQ(figures[2].rows.groups.size(), 2U);  // a row per contact source
}

TEST(ClosedLoop, IsTheSameInShardsAndWhenResumed) {
  const ScratchFolder folder;
  const Experiment experiment = with_closed_loop(folder, of_steps(folder, two_heights));
  RunOptions options;
  options.out = folder / "whole";
  run_experiment(experiment, options);
  const std::string table = read_file(folder / "whole/tables/survival.csv");
  const std::string results = read_file(folder / "whole/tables/results.csv");
  const std::string state = read_file(folder / "whole/state/closed_loop/run_000019");

  std::filesystem::remove(folder / "whole/state/closed_loop/run_000019");
  std::filesystem::remove(folder / "whole/tables/survival.csv");
  run_experiment(experiment, options);
  EXPECT_EQ(read_file(folder / "whole/tables/survival.csv"), table);
  EXPECT_EQ(read_file(folder / "whole/state/closed_loop/run_000019"), state);

  options.out = folder / "shards";
  run_shard(experiment, Shard{1, 2}, options);
  run_shard(experiment, Shard{2, 2}, options);
  EXPECT_EQ(entries_in(folder / "shards/state/closed_loop").size(),
            entries_in(folder / "whole/state/closed_loop").size());
  std::filesystem::remove(folder / "shards/state/closed_loop/run_000031");
  finish_run(folder / "shards", options);
  EXPECT_EQ(read_file(folder / "shards/tables/survival.csv"), table);
  EXPECT_EQ(read_file(folder / "shards/tables/results.csv"), results);
}

TEST(ClosedLoop, ContactSourcesDecideAsInOfflineEvaluation) {
  // The reference: the recorded run, evaluated offline with the same sensors and noise. The load
  // filter uses the servos' targets, too.
  const ScratchFolder folder;
  for (const char* sensors :
       {"noise/profiles/upkie.yaml", "noise/profiles/harsh.yaml", "noise/profiles/ideal.yaml"}) {
    const RunRequest request = request_of(
        with_closed_loop(folder,
                         of_steps(folder, ", noise: [{torque: 0.3, accelerometer: 1.0}]") +
                             "  contact: [load_filter]\n",
                         sensors, "[load_filter]"));
    const Experiment& experiment = request.experiment;
    scenarios::CompiledScenes scenes;
    const ClosedLoopCell cell = closed_loop_cells(experiment).front();
    const ClosedLoopRun loop = run_closed_loop(request, cell, 1, {}, scenes, [] { return true; });
    logs::Recording reported = loop.recording;
    report_through_sensors(profile_of(request.sensors, experiment.sensors), experiment, 1,
                           reported);
    const RunSignals run =
        signals_of(reported, experiment.labels, experiment.scoring, experiment.intervals.over);
    const auto estimator = estimator_entry("load_filter").make({.legs = run.legs});
    const auto offline =
        predict(*estimator, run, noise_run(run, noise_key(experiment, 0, 1)), cell.noise.levels());
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      EXPECT_EQ(loop.trace.contact[wheel], offline[wheel].contact) << sensors;
    }
    EXPECT_THAT(loop.trace.contact[0], AllOf(Contains(0), Contains(1))) << sensors;
  }
}

TEST(ClosedLoop, StartsAllRunsEquallyForEveryContactSource) {
  const ScratchFolder folder;
  const RunRequest request = request_of(with_closed_loop(folder, of_steps(folder, "")));
  scenarios::CompiledScenes scenes;
  std::vector<std::string> scripts;
  for (const ClosedLoopCell& cell : closed_loop_cells(request.experiment)) {
    if (cell.contact == "robust") continue;  // it needs a fit
    scenarios::Scenario rollout =
        run_closed_loop(request, cell, 1, {}, scenes, [] { return true; }).scenario;
    EXPECT_EQ(rollout.policy.contact, cell.contact);
    rollout.policy = {};
    scripts.push_back(scenarios::to_yaml(rollout));
  }
  ASSERT_GT(scripts.size(), 4U);
  EXPECT_THAT(scripts, ::testing::Each(scripts.front()));
}

using RecordedContact = std::array<scoring::ContactSequence, models::wheel_count>;

/// A robot that glides level at .5 m/s with wheels that turn at `wheel_speed`, m/s along the
/// ground: 100 ms on it, 100 ms off it, 100 ms on it.
logs::Recording gliding(double wheel_speed) {
  logs::Recording recording;
  recording.info.outcome = logs::Outcome::finished;
  for (int k = 0; k < 300; ++k) {
    models::Observation observation;
    observation.time = 1e-3 * k;
    observation.pitch = k == 150 ? -0.25 : 0.1;
    observation.servo[models::index(models::Servo::left_wheel)].velocity = wheel_speed / 0.05;
    observation.servo[models::index(models::Servo::right_wheel)].velocity = -wheel_speed / 0.05;
    models::GroundTruth truth;
    truth.imu_linear_velocity = {0.5, 0.0, 0.0};
    const bool in_contact = k < 100 || k >= 200;
    truth.wheel_normal_force = {in_contact ? 26.0 : 0.0, in_contact ? 30.0 : 0.0};
    recording.observation.push_back(observation);
    recording.action.emplace_back();
    recording.truth.push_back(truth);
  }
  return recording;
}

RecordedContact true_contact() {
  RecordedContact trace;
  for (scoring::ContactSequence& wheel : trace) {
    wheel.assign(300, 1);
    std::fill(wheel.begin() + 100, wheel.begin() + 200, 0);
  }
  return trace;
}

ClosedLoopMetrics metrics_of(const logs::Recording& recording, const RecordedContact& trace) {
  return closed_loop_metrics_of(recording, trace, odometry::upkie(), {}, {.skip = 0.0});
}

TEST(TyreSpeeds, AreThoseOfTheWheelsOverTheGround) {
  const logs::Recording run = gliding(0.8);
  for (const double speed : tyre_speeds(run.observation[0], run.truth[0], odometry::upkie())) {
    EXPECT_NEAR(speed, 0.3, 1e-12);
  }
}

TEST(TyreSpeeds, AreZeroWhereARobotPitchesAboutItsAxlesAndRolls) {
  // The robot pitches about the axle .471 m below the IMU at 2 rad/s; the axle moves at .4 m/s and
  // the wheels roll. The legs turn with the base, so the wheels' spin relative to it is 2 rad/s
  // less.
  models::Observation observation;
  const double spin = 0.4 / 0.05 - 2.0;
  observation.servo[models::index(models::Servo::left_wheel)].velocity = spin;
  observation.servo[models::index(models::Servo::right_wheel)].velocity = -spin;
  models::GroundTruth truth;
  truth.base_angular_velocity = {0.0, 2.0, 0.0};
  const double height = 0.064 + 0.168 + 0.175;
  truth.imu_linear_velocity = {0.4 + 2.0 * height, 0.0, 0.0};
  for (const double speed : tyre_speeds(observation, truth, odometry::upkie())) {
    EXPECT_NEAR(speed, 0.0, 1e-12);
  }
}

TEST(ClosedLoopMetrics, CountsLandingsByTheSpeedOfTheirTyres) {
  const ClosedLoopMetrics found = metrics_of(gliding(0.8), true_contact());
  EXPECT_EQ(found.runs, 1);
  EXPECT_EQ(found.finished, 1);
  EXPECT_EQ(found.fell, 0);
  EXPECT_EQ(found.landings, 2);  // one of each wheel
  EXPECT_NEAR(found.landing_speed_rms(), 0.3, 1e-12);
  EXPECT_EQ(found.mean_largest_pitch(), 0.25);
  EXPECT_EQ(found.mean_largest_force(), 30.0);
  EXPECT_EQ(found.contact_us, 200'000);
  EXPECT_EQ(found.false_takeoffs, 0);
}

TEST(ClosedLoopMetrics, CountsFalseTakeoffsOfTheRobot) {
  RecordedContact trace = true_contact();
  for (scoring::ContactSequence& wheel : trace) wheel[20] = 0;
  EXPECT_EQ(metrics_of(gliding(0.5), trace).false_takeoffs, 1);
  trace[1] = true_contact()[1];  // one wheel alone is no takeoff: the robot stands on the other
  EXPECT_EQ(metrics_of(gliding(0.5), trace).false_takeoffs, 0);
}

TEST(ClosedLoopMetrics, TakesNoHopForALanding) {
  logs::Recording run = gliding(0.8);
  for (int k = 100; k < 160; ++k) {  // 40 ms are left
    run.truth[static_cast<std::size_t>(k)].wheel_normal_force = {26.0, 26.0};
  }
  const ClosedLoopMetrics found = metrics_of(run, true_contact());
  EXPECT_EQ(found.landings, 0);
  EXPECT_TRUE(std::isnan(found.landing_speed_rms()));
}

TEST(ClosedLoopMetrics, AddsUp) {
  logs::Recording fallen = gliding(0.4);
  fallen.info.outcome = logs::Outcome::fell;
  ClosedLoopMetrics sum = metrics_of(gliding(0.8), true_contact());
  sum += metrics_of(fallen, true_contact());
  EXPECT_EQ(sum.runs, 2);
  EXPECT_EQ(sum.finished, 1);
  EXPECT_EQ(sum.fell, 1);
  EXPECT_NEAR(sum.landing_speed_rms(), std::sqrt(0.5 * (0.3 * 0.3 + 0.1 * 0.1)), 1e-12);
  EXPECT_NEAR(sum.mean_largest_pitch(), 0.25, 1e-12);
}

}  // namespace
}  // namespace touchdown::experiments
