#include <cmath>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_experiment.hpp"
#include "render/report/report.hpp"
#include "tests/experiments/small_step_scene.hpp"
#include "tests/experiments/studies/study_test.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

namespace fs = std::filesystem;

/// Three runs over a small step with the study's section.
Experiment with(const ScratchFolder& folder, const std::string& section) {
  const std::string scene = folder.write("small_step.yaml", small_step_scene).string();
  return experiment_from_yaml(YamlDocument::parse(
      "name: prompt\nsimulators: [mujoco]\nestimators: [measurement_only, free_fall]\n"
      "fit: {scenarios: [" +
          scene + "], runs: 2, perturbed: true}\ntest: {scenarios: [" + scene +
          "], runs: 3}\nvideo: {enabled: false}\n" + section,
      "prompt.yaml"));
}

/// From decisions at every step: the first delays of all flights of both wheels, in steps; -1 where
/// a flight is missed.
std::vector<int> delays(const ExperimentResult& result, const std::string& estimator) {
  std::vector<int> all;
  for (const FinishedRun& run : result.runs) {
    if (run.plan.role != RunRole::test) continue;
    const RunSignals signals = signals_of(run, result.experiment);
    const auto runner =
        make_estimator(result.experiment, {"mujoco", "mujoco", estimator}, result.models, signals);
    const NoiseRun noise = noise_run(signals, noise_key(result.experiment, 0, run.plan.run));
    const auto decided = decide(*runner, signals, noise, result.cells.front().levels());
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      const auto& truth = signals.contact[wheel];
      int since = -1;  // steps since the takeoff of a flight that is not detected
      for (std::size_t k = 1; k < truth.size(); ++k) {
        if (truth[k] != 0 && since >= 0) all.push_back(-1);
        if (truth[k] != 0) since = -1;
        if (truth[k] == 0 && truth[k - 1] != 0) since = 0;
        if (since < 0) continue;
        if (decided[wheel][k] == 0) {
          all.push_back(since);
          since = -1;
        } else {
          ++since;
        }
      }
    }
  }
  return all;
}

TEST(ExampleStudy, MeasuresTheSharesOfFlightsThatItsMetricDefines) {
  for (const double within : {0.0, 0.02, 0.5}) {
    const ScratchFolder folder;
    const Experiment experiment =
        with(folder, "prompt_takeoffs: {within: " + std::to_string(within) + "}\n");
    const ExperimentResult result = run_in(folder, experiment);
    const Table table = result.directory.read_table("prompt_takeoffs.csv");
    ASSERT_EQ(table.rows.size(), 3U);  // two estimators and always contact
    for (const TableRow& row : table.all()) {
      const std::vector<int> found = delays(result, row.text("estimator"));
      ASSERT_GE(found.size(), 6U);
      const auto prompt = std::count_if(found.begin(), found.end(), [&](int delay) {
        return delay >= 0 && delay <= std::lround(1000.0 * within);
      });
      EXPECT_NEAR(row.number("prompt_share"),
                  static_cast<double>(prompt) / static_cast<double>(found.size()), 1e-4)
          << row.text("estimator") << " within " << within;
      EXPECT_EQ(row.text("runs"), "3");
    }
    EXPECT_THAT(result.studies.back(), HasSubstr("Flights detected soon after takeoff"));
  }
}

TEST(ExampleStudy, GetsItsFigureItsResultsAndItsCleaningFromOthers) {
  const ScratchFolder folder;
  ExperimentResult result = run_in(folder, with(folder, "prompt_takeoffs: {}\n"));
  EXPECT_THAT(read_file(folder / "run/tables/results.csv"), HasSubstr("\nprompt_takeoffs,mujoco,"));
  ASSERT_EQ(result.figures.size(), 1U);
  EXPECT_EQ(result.figures[0].panels.groups.size(), result.experiment.highlights.size());
  render::draw_pictures(result, {}, {}, true, nullptr);
  EXPECT_TRUE(fs::exists(folder / "run/figures/prompt_takeoffs.png"));
  folder.write("run/tables/mine.csv", "precious");
  remove_own_files(folder / "run");
  EXPECT_FALSE(fs::exists(folder / "run/tables/prompt_takeoffs.csv"));
  EXPECT_FALSE(fs::exists(folder / "run/figures/prompt_takeoffs.png"));
  EXPECT_TRUE(fs::exists(folder / "run/tables/mine.csv"));
}

TEST(ExampleStudy, IsTheSameInShards) {
  const ScratchFolder folder;
  expect_same_in_shards(folder, with(folder, "prompt_takeoffs: {within: 0.03}\n"), 3,
                        {"tables/prompt_takeoffs.csv", "tables/results.csv"});
}

TEST(ExampleStudy, HasASectionLikeAnyOther) {
  const ScratchFolder folder;
  const Experiment without = with(folder, "");
  EXPECT_THAT(to_yaml(without), Not(HasSubstr("prompt_takeoffs")));
  const std::string text = reread_yaml(with(folder, "prompt_takeoffs: {within: 0.25}\n"));
  EXPECT_THAT(text, HasSubstr("prompt_takeoffs:\n  within: 0.25\n"));
  EXPECT_NE(request_of(without).id, request_of(with(folder, "prompt_takeoffs: {}\n")).id);
  const auto complaint = [&](const std::string& section, const char* expected) {
    EXPECT_THAT([&] { with(folder, section); },
                ThrowsMessage<InputError>(AllOf(HasSubstr("prompt.yaml:7:"), HasSubstr(expected))));
  };
  complaint("prompt_takeofs: {}\n", "did you mean 'prompt_takeoffs'?");
  complaint("prompt_takeoffs: {withn: 0.1}\n", "did you mean 'within'?");
  complaint("prompt_takeoffs: {within: 2}\n", "from 0 to 1");
  complaint("prompt_takeoffs: {within: soon}\n", "a number");
  const std::vector<Key> keys = experiment_keys();
  EXPECT_TRUE(std::any_of(keys.begin(), keys.end(), [](const Key& key) {
    return key.path == "prompt_takeoffs.within" && key.unit == "s";
  }));
}

TEST(ExampleStudy, IsAtMostEightyLines) {
  std::ifstream file(TOUCHDOWN_SOURCE_DIR "/examples/study/prompt_takeoffs.cpp");
  int lines = 0;
  for (std::string line; std::getline(file, line);) ++lines;
  EXPECT_LE(lines, 80);
  EXPECT_GT(lines, 40);
}

}  // namespace
}  // namespace touchdown::experiments
