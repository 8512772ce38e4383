#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/table.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "scoring/trajectory.hpp"
#include "tests/experiments/studies/study_test.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

Experiment with_odometry(const ScratchFolder& folder, const std::string& more) {
  const std::string step = folder.write("small_step.yaml", small_step_scene).string();
  return experiment_from_yaml(YamlDocument::parse(
      "name: small\nestimators: [load_filter, robust]\nsensors: noise/profiles/upkie.yaml\nfit: "
      "{scenarios: [" +
          step + "]}\ntest: {scenarios: [" + step +
          "], runs: 2}\nrecordings: none\nvideo: {enabled: false}\n" + more,
      "small.yaml"));
}

/// One column of one engine, by contact source.
std::map<std::string, double> column(const Table& table, const std::string& simulator,
                                     const std::string& name) {
  std::map<std::string, double> values;
  for (const TableRow& row : table.all()) {
    if (row.text("simulator") != simulator || row.text("sensors") != "upkie") continue;
    values[row.text("contact")] = row.number(name);
  }
  return values;
}

scoring::Trajectory read_tum(const std::filesystem::path& file) {
  scoring::Trajectory trajectory;
  std::istringstream text(read_file(file));
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with('#')) continue;
    std::istringstream numbers(line);
    scoring::TimedPose pose;
    auto& q = pose.orientation;
    numbers >> pose.time >> pose.position.x() >> pose.position.y() >> pose.position.z() >> q.x() >>
        q.y() >> q.z() >> q.w();
    EXPECT_FALSE(numbers.fail()) << line;
    trajectory.push_back(pose);
  }
  return trajectory;
}

const char* const odometry_section =
    "odometry: {delay: [0.1]}\nbenchmark: {sensors: [noise/profiles/ideal.yaml]}\n";

TEST(OdometryStudy, ScoresOdometryWithEveryEstimatorAndTheTruth) {
  const ScratchFolder folder;
  const ExperimentResult result = run_in(folder, with_odometry(folder, odometry_section));
  const Table table = result.directory.read_table("odometry.csv");
  const std::vector<std::string> header = texts_of(table).header;
  ASSERT_GE(header.size(), 7U);
  EXPECT_THAT(std::vector<std::string>(header.begin(), header.begin() + 7),
              ::testing::ElementsAre("simulator", "scenario", "contact", "rms_m", "rms_m_low",
                                     "rms_m_high", "error_per_metre"));
  ASSERT_EQ(table.rows.size(), 2U * 2U * 5U);  // engines, sensors, sources
  for (const char* simulator : {"mujoco", "bullet"}) {
    const auto error = column(table, simulator, "rms_m");
    std::vector<std::string> names;
    for (const auto& [name, value] : error) names.push_back(name);
    EXPECT_THAT(names, UnorderedElementsAre("always", "truth", "truth_delayed_100ms", "load_filter",
                                            "robust"));
    // 2 m with one fall: with the truth the error is centimetres, with a delay of .1 s it is
    // larger.
    EXPECT_LT(error.at("truth"), 0.03);
    const auto speed = column(table, simulator, "velocity_rms_mps");
    EXPECT_GT(speed.at("truth_delayed_100ms"), 1.3 * speed.at("truth"));
    EXPECT_GT(column(table, simulator, "height_rms_m").at("always"), 0.05);
    EXPECT_NEAR(column(table, simulator, "distance_m").at("truth"), 2 * 1.7, 1.0);
  }
  for (const TableRow& row : table.all()) {
    const bool is_truth = row.text("contact").starts_with("truth");
    EXPECT_EQ(row.text("is_oracle"), is_truth ? "1" : "0");
    EXPECT_LE(row.number("rms_m_low"), row.number("rms_m"));
    EXPECT_GE(row.number("rms_m_high"), row.number("rms_m"));
    EXPECT_EQ(row.text("runs"), "2");
  }
  EXPECT_THAT(result.studies.back(), HasSubstr("Truth, delayed 100 ms (oracle)"));
  ASSERT_EQ(result.figures.size(), 4U);  // two of the benchmark itself
  const FigureSpec& figure = result.figures[2];
  EXPECT_EQ(figure.name, "odometry_upkie_upkie");
  EXPECT_EQ(result.figures[3].name, "odometry_upkie_ideal");
  // The contact sources are ranked by their errors, summed over engines.
  std::map<std::string, double> sums = column(table, "mujoco", "rms_m");
  for (const auto& [contact, error] : column(table, "bullet", "rms_m")) sums[contact] += error;
  double last = 0.0;
  ASSERT_EQ(figure.rows.groups.size(), sums.size());
  for (const FigureGroup& contact : figure.rows.groups) {
    EXPECT_GE(sums.at(contact.values.front()), last);
    last = sums.at(contact.values.front());
  }
}

TEST(OdometryStudy, WritesTrajectoriesThatGiveTheTablesNumbers) {
  const ScratchFolder folder;
  Experiment experiment = with_odometry(folder, "odometry: {}\n");
  experiment.test.runs = 1;
  experiment.simulators = {"mujoco"};
  const ExperimentResult result = run_in(folder, experiment);
  const Table table = result.directory.read_table("odometry.csv");
  const auto file = [&](const std::string& name) {
    return folder / ("run/trajectories/mujoco_small_step_" + name + ".tum");
  };
  const scoring::Trajectory truth = read_tum(file("ground_truth"));
  ASSERT_GT(truth.size(), 100U);
  EXPECT_NEAR(truth[1].time - truth[0].time, 0.01, 1e-9);
  for (const char* contact : {"truth", "always", "robust"}) {
    const scoring::TrajectoryScore score =
        scoring::score_trajectory(read_tum(file(contact)), truth);
    const double rms = column(table, "mujoco", "rms_m").at(contact);
    EXPECT_NEAR(score.rms(), rms, 0.03 * rms) << contact;  // every tenth step
    const double ate = column(table, "mujoco", "ate_m").at(contact);
    EXPECT_NEAR(score.ate(), ate, 0.03 * ate) << contact;
  }
  EXPECT_THAT(own_files(folder / "run"),
              Contains(std::filesystem::path("trajectories/mujoco_small_step_truth.tum")));
  EXPECT_THAT(own_files(folder / "run"), Contains(std::filesystem::path("tables/odometry.csv")));
}

}  // namespace
}  // namespace touchdown::experiments
