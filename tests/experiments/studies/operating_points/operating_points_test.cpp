#include <algorithm>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/table.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_directory/shard.hpp"
#include "experiments/run_experiment.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "experiments/studies/operating_points/rows.hpp"
#include "tests/experiments/small_step_scene.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Experiment with(const ScratchFolder& folder, const std::string& more) {
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

const char* const study =
    "operating_points: {leave_below: [0.2, 0.8], return_above: [0.1, 0.8, 0.95]}\n";

Table table_in(const ScratchFolder& folder, const std::string& name) {
  return from_csv(read_file(folder / name));
}

TEST(OperatingPoints, ScoreOtherThresholdsThanTheEstimators) {
  const ScratchFolder folder;
  RunOptions options;
  options.out = folder / "run";
  const ExperimentResult result = run_experiment(with(folder, study), options);
  const Table table = table_in(folder, "run/tables/operating_points_by_scene.csv");
  // Engines, estimators, noise settings; its own decision and two times two pairs: none of 0.1.
  ASSERT_EQ(table.rows.size(), 2U * 2U * 2U * 5U);
  std::map<std::string, std::vector<std::string>> own, at_its_own_threshold;
  for (const std::vector<std::string>& row : table.rows) {
    const std::string key = row[0] + row[2] + row[4];
    EXPECT_EQ(cell(table, row, "scenario"), "small_step");
    if (cell(table, row, "estimator") != "robust") continue;
    const std::vector<std::string> numbers(row.begin() + 7, row.end());
    if (cell(table, row, "leave_below").empty()) own[key] = numbers;
    const bool is_its_own =
        cell(table, row, "leave_below") == "0.8" && cell(table, row, "return_above") == "0.8";
    if (is_its_own) at_its_own_threshold[key] = numbers;
  }
  EXPECT_EQ(own.size(), 4U);
  EXPECT_EQ(own, at_its_own_threshold);  // the Bayes filter decides at 0.8
  EXPECT_THAT(result.studies.back(), HasSubstr("Bayes filter (robust)"));
  EXPECT_THAT(own_files(folder / "run"),
              Contains(std::filesystem::path("tables/operating_points.csv")));
}

OperatingRow row_of(const std::string& scene, std::optional<scoring::Hysteresis> thresholds,
                    std::int64_t wrong, std::int64_t switches) {
  OperatingRow row{"mujoco", scene, {1.0, 5.0}, "robust", thresholds, {}};
  row.score.points.contact_as_contact = 1000 - wrong;
  row.score.points.contact_as_flight = wrong;
  row.score.extra_switches = switches;
  row.score.flights = scene == "stairs" ? 10 : 0;
  row.score.scored_us = 60'000'000;
  return row;
}

TEST(OperatingPoints, ScenesHaveEqualWeightsAndTheFrontIsNotDominated) {
  const scoring::Hysteresis fast{0.9, 0.9}, slow{0.1, 0.9}, worse{0.5, 0.5}, equal{0.4, 0.5};
  const std::vector<OperatingMean> means = operating_means(
      {row_of("stairs", {}, 10, 6), row_of("stairs", fast, 0, 8), row_of("stairs", slow, 40, 0),
       row_of("stairs", worse, 40, 8), row_of("stairs", equal, 40, 0), row_of("roam", {}, 30, 2),
       row_of("roam", fast, 20, 4), row_of("roam", slow, 0, 0), row_of("roam", worse, 20, 4),
       row_of("roam", equal, 0, 0)});
  ASSERT_EQ(means.size(), 5U);
  EXPECT_EQ(means[0].thresholds, std::nullopt);
  EXPECT_DOUBLE_EQ(means[0].balanced_accuracy, 0.98);
  EXPECT_DOUBLE_EQ(means[0].extra_switches_per_minute, 4.0);
  EXPECT_DOUBLE_EQ(means[0].extra_switches_per_flight, 0.8);
  const auto is_on_front = [&](const scoring::Hysteresis& thresholds) {
    return std::find_if(means.begin(), means.end(),
                        [&](const OperatingMean& mean) { return mean.thresholds == thresholds; })
        ->is_on_front;
  };
  EXPECT_TRUE(is_on_front(fast));
  EXPECT_TRUE(is_on_front(slow));
  EXPECT_TRUE(is_on_front(equal));
  EXPECT_FALSE(is_on_front(worse));
  EXPECT_FALSE(means[0].is_on_front);
}

TEST(OperatingPoints, AreTheSameInShards) {
  const ScratchFolder folder;
  const Experiment experiment = with(folder, study);
  RunOptions options;
  options.out = folder / "whole";
  run_experiment(experiment, options);
  options.out = folder / "shards";
  run_shard(experiment, Shard{1, 2}, options);
  run_shard(experiment, Shard{2, 2}, options);
  merge_run(folder / "shards", options);
  for (const char* name : {"operating_points.csv", "operating_points_by_scene.csv"}) {
    EXPECT_EQ(read_file(folder / "whole/tables" / name), read_file(folder / "shards/tables" / name))
        << name;
  }
}

TEST(OperatingPoints, AreInTheConfigurationOnlyIfSet) {
  const ScratchFolder folder;
  EXPECT_THAT(to_yaml(with(folder, "")), Not(HasSubstr("operating_points")));
  const std::string text = to_yaml(with(folder, "operating_points: {leave_below: [0.25, 0.5]}\n"));
  EXPECT_THAT(text, HasSubstr("leave_below: [0.25, 0.5]"));
  EXPECT_EQ(text, to_yaml(experiment_from_yaml(YamlDocument::parse(text, "again.yaml"))));
}

TEST(OperatingPoints, ComplainOnTheLine) {
  const ScratchFolder folder;
  const auto complaint = [&](const std::string& text) -> std::string {
    try {
      (void)with(folder, text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no complaint";
  };
  EXPECT_THAT(complaint("operating_points: {leave_below: [0.5, 0.2]}\n"),
              AllOf(HasSubstr("small.yaml:9:"), HasSubstr("operating_points.leave_below"),
                    HasSubstr("expected increasing probabilities")));
  EXPECT_THAT(complaint("operating_points: {return_above: [0.5, 1]}\n"),
              HasSubstr("none of them 0 or 1"));
  EXPECT_THAT(complaint("operating_points: {leave_below: []}\n"),
              HasSubstr("expected at least one probability"));
  EXPECT_THAT(complaint("operating_points: {leave_below: [0.9], return_above: [0.5]}\n"),
              HasSubstr("at least the lowest leave_below"));
  EXPECT_THAT(complaint("operating_points: {leave_bellow: [0.5]}\n"), HasSubstr("did you mean"));
}

}  // namespace
}  // namespace touchdown::experiments
