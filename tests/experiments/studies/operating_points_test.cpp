#include <algorithm>
#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/run_directory/own_files.hpp"
#include "tests/experiments/studies/study_test.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

Experiment with_operating_points(const ScratchFolder& folder, const std::string& more) {
  const std::string step = folder.write("small_step.yaml", small_step_scene).string();
  return experiment_from_yaml(YamlDocument::parse(
      "name: small\nestimators: [robust, free_fall]\nfit: {scenarios: [" + step +
          "]}\ntest: {scenarios: [" + step +
          "], runs: 2}\nrecordings: none\nvideo: {enabled: false}\n"
          "noise: {torque: [0, 1], accelerometer: [0, 5]}\n"
          "highlights: [{torque: 0, accelerometer: 0}, {torque: 1, accelerometer: 5}]\n" +
          more,
      "small.yaml"));
}

const char* const points_section =
    "operating_points: {leave_below: [0.2, 0.8], return_above: [0.1, 0.8, 0.95]}\n";

TEST(OperatingPoints, ScoreOtherThresholdsThanTheEstimators) {
  const ScratchFolder folder;
  const ExperimentResult result = run_in(folder, with_operating_points(folder, points_section));
  const Table table = result.directory.read_table("operating_points_by_scene.csv");
  // Engines, estimators, noise settings; its own decision and two times two pairs: none of 0.1.
  ASSERT_EQ(table.rows.size(), 2U * 2U * 2U * 5U);
  std::map<std::string, std::vector<std::string>> own, at_its_own_threshold;
  for (const TableRow& row : table.all()) {
    const std::vector<std::string> cells = row.texts();
    const std::string key = cells[0] + cells[2] + cells[4];
    EXPECT_EQ(row.text("scenario"), "small_step");
    if (row.text("estimator") != "robust") continue;
    const std::vector<std::string> numbers(cells.begin() + 8, cells.end());
    if (row.text("leave_below").empty()) own[key] = numbers;
    const bool is_its_own = row.text("leave_below") == "0.8" && row.text("return_above") == "0.8";
    if (is_its_own) at_its_own_threshold[key] = numbers;
  }
  EXPECT_EQ(own.size(), 4U);
  EXPECT_EQ(own, at_its_own_threshold);  // the Bayes filter decides at 0.8
  EXPECT_THAT(result.studies.back(), HasSubstr("Bayes filter (robust)"));
  EXPECT_THAT(own_files(folder / "run"),
              Contains(std::filesystem::path("tables/operating_points.csv")));
}

TEST(OperatingPoints, ScenesHaveEqualWeightsAndTheFrontIsNotDominated) {
  const ScratchFolder folder;
  Experiment experiment = with_operating_points(folder, points_section);
  const std::string stand =
      folder.write("stand.yaml", "name: stand\nend: {duration: 1.0}\nperturbation: {yaw: 0.05}\n");
  experiment.test.scenarios.push_back(stand);
  const ExperimentResult result = run_in(folder, experiment);
  const Table rows = result.directory.read_table("operating_points_by_scene.csv");
  const Table means = result.directory.read_table("operating_points.csv");
  const auto point_of = [](const TableRow& row) {
    std::string point;
    for (const char* column : {"torque_noise_nm", "estimator", "leave_below", "return_above"}) {
      point += row.text(column) + " ";
    }
    return point;
  };
  ASSERT_EQ(means.rows.size(), 2U * 2U * 5U);
  ASSERT_EQ(rows.rows.size(), 4 * means.rows.size());  // two scenes in two engines
  for (const TableRow& mean : means.all()) {
    double accuracy = 0.0, switches = 0.0, extra = 0.0, flights = 0.0;
    std::vector<double> errors;  // nan where nothing takes off
    for (const TableRow& row : rows.all()) {
      if (point_of(row) != point_of(mean)) continue;
      accuracy += row.number("balanced_accuracy") / 4.0;
      switches += row.number("extra_switches_per_minute") / 4.0;
      extra += row.number("extra_switches");
      flights += row.number("flights");
      const double error = row.number("takeoff_error_ms");
      if (!std::isnan(error)) errors.push_back(error);
    }
    EXPECT_NEAR(mean.number("balanced_accuracy"), accuracy, 1e-6);
    EXPECT_NEAR(mean.number("extra_switches_per_minute"), switches, 1e-6);
    EXPECT_NEAR(mean.number("extra_switches_per_flight"), extra / flights, 1e-6);
    ASSERT_LE(errors.size(), 2U);
    if (errors.size() == 2) {
      EXPECT_NEAR(mean.number("takeoff_error_ms"), 0.5 * (errors[0] + errors[1]), 1e-6);
    }
    bool is_dominated = false;
    for (const TableRow& other : means.all()) {
      const bool is_rival = other.text("estimator") == mean.text("estimator") &&
                            other.text("torque_noise_nm") == mean.text("torque_noise_nm") &&
                            !other.text("leave_below").empty();
      const double gain = other.number("balanced_accuracy") - mean.number("balanced_accuracy");
      const double fewer =
          mean.number("extra_switches_per_minute") - other.number("extra_switches_per_minute");
      is_dominated =
          is_dominated || (is_rival && gain >= 0.0 && fewer >= 0.0 && gain + fewer > 0.0);
    }
    const bool is_own = mean.text("leave_below").empty();
    EXPECT_EQ(mean.text("on_front"), !is_own && !is_dominated ? "1" : "0") << point_of(mean);
  }
  ASSERT_EQ(result.figures.size(), 1U);
  const FigureSpec& figure = result.figures.front();
  ASSERT_EQ(figure.panels.groups.size(), 2U);
  EXPECT_EQ(figure.panels.groups[1].title, "1 N·m, 5 m/s²");
  ASSERT_EQ(figure.series.groups.size(), 2U);
  EXPECT_EQ(figure.series.groups[0].title, "Bayes filter (robust)");
  EXPECT_EQ(figure.colour_order, experiment.estimators);
  EXPECT_THAT(figure.caption, HasSubstr("normal force > 1 N"));
  EXPECT_THAT(figure.alt, HasSubstr("Bayes filter (robust) by its own decision"));
}

}  // namespace
}  // namespace touchdown::experiments
