#include <set>

#include <fmt/format.h>
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

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

struct LearningCurve : ::testing::Test {
  /// Four fitted runs over a small step, two test runs.
  Experiment experiment(const std::string& more, const std::string& fit = "") const {
    const std::string scene = folder.write("small_step.yaml", small_step_scene).string();
    const std::string fitted =
        fit.empty() ? "{scenarios: [" + scene + "], runs: 4, perturbed: true}" : fit;
    return experiment_from_yaml(YamlDocument::parse(
        "name: curve\nsimulators: [mujoco]\nfit: " + fitted + "\ntest: {scenarios: [" + scene +
            "], runs: 2}\nrecordings: none\nvideo: {enabled: false}\n"
            "noise: {torque: [0, 1], accelerometer: [0, 5]}\n"
            "highlights: [{torque: 0, accelerometer: 0}, {torque: 1, accelerometer: 5}]\n" +
            more,
        "curve.yaml"));
  }

  ExperimentResult run(const Experiment& experiment, const std::string& name = "run") const {
    return run_in(folder, experiment, name);
  }

  TextTable table(const std::string& name = "run") const {
    return from_csv(read_file(folder / (name + "/tables/learning_curve.csv")));
  }

  ScratchFolder folder;
};

/// The cells of a column.
std::vector<std::string> column(const TextTable& table, const std::string& name) {
  std::vector<std::string> cells;
  for (const auto& row : table.rows) cells.push_back(cell(table, row, name));
  return cells;
}

/// The success of an estimator's own fit, by highlighted noise setting, as tables have it.
std::vector<std::string> own_success(const ExperimentResult& result, const std::string& estimator) {
  std::vector<std::string> found;
  for (const ScoreSummary& score : result.scores) {
    if (score.view == "wheels" && score.condition.estimator == estimator) {
      found.push_back(metric(score["success"].estimate));
    }
  }
  return found;
}

TEST_F(LearningCurve, OfAllRunsHasTheScoresOfTheExperimentsOwnFits) {
  const ExperimentResult result =
      run(experiment("estimators: [robust, free_fall, force_kinematics, phase]\n"
                     "learning_curve: {sizes: [4]}\n"));
  const TextTable all = table();
  // Three of the four are fitted; two noise settings.
  EXPECT_EQ(column(all, "estimator"),
            (std::vector<std::string>{"robust", "robust", "force_kinematics", "force_kinematics",
                                      "phase", "phase"}));
  std::vector<std::string> expected;
  for (const char* estimator : {"robust", "force_kinematics", "phase"}) {
    for (std::string& success : own_success(result, estimator)) expected.push_back(success);
  }
  EXPECT_EQ(column(all, "success"), expected);
  EXPECT_THAT(column(all, "draws"), Each("1"));
  EXPECT_THAT(column(all, "runs"), Each("2"));
  ASSERT_EQ(result.figures.size(), 1U);
  const FigureSpec& figure = result.figures.front();
  ASSERT_EQ(figure.panels.groups.size(), 2U);  // one engine, two noise settings
  EXPECT_EQ(figure.panels.groups[1].title, "MuJoCo, 1 N·m, 5 m/s²");
  ASSERT_EQ(figure.series.groups.size(), 3U);
  EXPECT_EQ(figure.series.groups[2].title, "Phase filter");
  EXPECT_THAT(figure.caption, HasSubstr("1 training set of each size"));
}

TEST_F(LearningCurve, OfAllSegmentsHasTheScoresOfAnEstimatorThatIsFittedToThem) {
  const std::string scene = folder.write("small_step.yaml", small_step_scene).string();
  const ExperimentResult result =
      run(experiment("estimators: [robust, phase]\nlearning_curve: {sizes: [1, 3]}\n",
                     "{scenarios: [" + scene + "], segments: [{scenario: " + scene +
                         ", runs: 3, after: 0.4, length: 2.5}]}"));
  const TextTable sizes = table();
  ASSERT_EQ(sizes.rows.size(), 8U);
  EXPECT_EQ(cell(sizes, sizes.rows[6], "estimator"), "phase");
  EXPECT_EQ(cell(sizes, sizes.rows[6], "size"), "3");
  EXPECT_EQ(cell(sizes, sizes.rows[6], "success"), own_success(result, "phase")[0]);
  EXPECT_EQ(cell(sizes, sizes.rows[7], "success"), own_success(result, "phase")[1]);
  EXPECT_EQ(cell(sizes, sizes.rows[4], "labelled_s"), "2.500");
}

TEST_F(LearningCurve, PlansSegmentsAlsoIfNoEstimatorLearnsFromThem) {
  const std::string scene = folder.write("small_step.yaml", small_step_scene).string();
  run(experiment("estimators: [robust]\nlearning_curve: {sizes: [2]}\n",
                 "{scenarios: [" + scene + "], segments: [{scenario: " + scene +
                     ", runs: 2, after: 0.4, length: 2.5}]}"));
  EXPECT_THAT(column(table(), "labelled_s"), Each("5.000"));
}

TEST_F(LearningCurve, NamesTheSecondsWithoutTheUnusedBeginningOfARun) {
  const ExperimentResult result =
      run(experiment("estimators: [robust]\nlearning_curve: {sizes: [1, 2]}\n"));
  double seconds = 0.0;
  std::vector<std::string> expected;
  for (const Rollout& one : result.runs) {
    if (one.plan.role != RunRole::fit || expected.size() == 4) continue;
    seconds += one.report.duration - 0.3;
    for (int cell = 0; cell < 2; ++cell) expected.push_back(fmt::format("{:.3f}", seconds));
  }
  EXPECT_EQ(column(table(), "labelled_s"), expected);
  EXPECT_THAT(result.studies.back(), HasSubstr("Bayes filter (robust)"));
}

TEST_F(LearningCurve, DrawsOtherTrainingSetsOfTheSameSize) {
  run(experiment("estimators: [force_kinematics]\nlearning_curve: {sizes: [1], draws: 4}\n"),
      "four");
  run(experiment("estimators: [force_kinematics]\nlearning_curve: {sizes: [1]}\n"), "one");
  const TextTable four = table("four"), one = table("one");
  ASSERT_EQ(four.rows.size(), 2U);
  EXPECT_EQ(cell(four, four.rows[0], "draws"), "4");
  EXPECT_NE(column(four, "balanced_accuracy"), column(one, "balanced_accuracy"));
  EXPECT_EQ(column(four, "labelled_s"), column(one, "labelled_s"));  // of the first set
}

TEST_F(LearningCurve, SimulatesNothingTwiceAndHasTasksOfItsOwn) {
  const std::string estimators = "estimators: [robust]\n";
  const std::size_t own = whole_plan(request_of(experiment(estimators))).tasks.size();
  const Plan plan = whole_plan(
      request_of(experiment(estimators + "learning_curve: {sizes: [1, 2], draws: 2}\n")));
  ASSERT_EQ(plan.tasks.size(), 2 * own);
  const auto again = plan.runs_in(*plan.group_called("learning_curve"));
  ASSERT_EQ(again.size(), plan.runs_in(0).size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    EXPECT_EQ(plan.runs[again[i]].file, plan.runs[plan.runs_in(0)[i]].file);
  }
  std::set<std::string> names;
  for (const Task& task : plan.tasks) names.insert(task_name(plan, task));
  EXPECT_EQ(names.size(), plan.tasks.size());
  EXPECT_EQ(plan.groups.back().conditions.size(), 4U);  // sizes, draws
}

TEST_F(LearningCurve, IsTheSameInShardsAndLeavesOtherTablesAndModelsAlone) {
  const std::string section = "learning_curve: {sizes: [1, 3], draws: 2}\n";
  const Experiment with = experiment("estimators: [robust, force_kinematics]\n" + section);
  expect_same_in_shards(folder, with, 3, {"tables/learning_curve.csv", "tables/results.csv"});
  run(experiment("estimators: [robust, force_kinematics]\n"), "without");
  const auto text = [&](const char* name, const char* file) {
    return read_file(folder / name / file);
  };
  for (const char* file : {"tables/success.csv", "tables/views.csv", "tables/transitions.csv"}) {
    EXPECT_EQ(text("whole", file), text("without", file)) << file;
  }
  const auto models = [&](const char* name) {
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder / name / "models")) {
      files.insert(entry.path().filename().string());
    }
    return files;
  };
  EXPECT_EQ(models("whole"), models("without"));
  EXPECT_THAT(own_files(folder / "whole"),
              Contains(std::filesystem::path("tables/learning_curve.csv")));
}

TEST_F(LearningCurve, NeedsAnEstimatorThatIsFitted) {
  EXPECT_THAT([&] { run(experiment("estimators: [free_fall]\nlearning_curve: {sizes: [1]}\n")); },
              ThrowsMessage<InputError>(HasSubstr("expected an estimator that is fitted")));
}

TEST_F(LearningCurve, NamesATrainingSetThatDoesNotSuffice) {
  const std::string scene = folder.write("small_step.yaml", small_step_scene).string();
  // The first second of a run has no flight.
  EXPECT_THAT(
      [&] {
        run(experiment("estimators: [robust]\nlearning_curve: {sizes: [1]}\n",
                       "{scenarios: [" + scene + "], segments: [{scenario: " + scene +
                           ", runs: 2, after: 0.3, length: 0.5}]}"));
      },
      ThrowsMessage<InputError>(AllOf(HasSubstr("training sets of 1, number 1"),
                                      HasSubstr("no-contact torques"),
                                      HasSubstr("expected larger sets"))));
}

}  // namespace
}  // namespace touchdown::experiments
