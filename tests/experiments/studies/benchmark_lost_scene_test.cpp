#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "core/table.hpp"
#include "experiments/run_experiment.hpp"
#include "tests/experiments/small_step_scene.hpp"
#include "tests/experiments/studies/study_test.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// Two scenes, in one of which every run ends early: pushed over, out of sight, or torn apart.
Experiment with_a_lost_scene(const ScratchFolder& folder, const std::string& force) {
  const std::string step = folder.write("small_step.yaml", small_step_scene).string();
  const std::string lost = folder
                               .write("lost.yaml",
                                      "name: lost\nend: {duration: 3.0}\nperturbation: {yaw: "
                                      "0.05}\nforces: [{time: 0.2, duration: "
                                      "0.5, force: " +
                                          force + "}]\n")
                               .string();
  return experiment_from_yaml(YamlDocument::parse(
      "name: small\nsimulators: [mujoco, bullet]\nestimators: [free_fall, always_contact]\n"
      "fit: {scenarios: [" +
          step + "], runs: 1}\ntest: {scenarios: [" + step + ", " + lost +
          "], runs: 2}\nnoise: {torque: [0]}\nhighlights: [{torque: 0, accelerometer: 0}]\n"
          "recordings: none\nvideo: {enabled: false}\nbenchmark: {}\n",
      "small.yaml"));
}

class LostScene : public ::testing::TestWithParam<const char*> {};

TEST_P(LostScene, IsARowWithoutScoresAndNoPartOfTheMean) {
  const ScratchFolder folder;
  const ExperimentResult result = run_in(folder, with_a_lost_scene(folder, GetParam()));
  const Table table = result.directory.read_table("benchmark.csv");
  int lost = 0;
  double sum = 0.0;
  int scored = 0;
  for (const TableRow& row : table.all()) {
    const bool is_lost = row.text("scene") == "lost";
    EXPECT_EQ(row.text("failed"), is_lost ? "2" : "0");
    EXPECT_EQ(row.text("runs"), "2");
    EXPECT_EQ(row.text("balanced_accuracy") == "nan", is_lost);
    EXPECT_EQ(row.text("success") == "nan", is_lost);
    lost += is_lost ? 1 : 0;
    if (is_lost || row.text("estimator") != "always_contact") continue;
    sum += row.number("balanced_accuracy");
    ++scored;
  }
  EXPECT_EQ(lost, 2 * 2) << "engines and estimators";
  const Table standings = result.directory.read_table("benchmark_standings.csv");
  ASSERT_EQ(standings.rows.size(), 2U);
  for (const TableRow& row : standings.all()) {
    EXPECT_EQ(row.text("scored_scenes"), "2");
    EXPECT_EQ(row.text("planned_scenes"), "4");
    if (row.text("estimator") != "always_contact") continue;
    EXPECT_NEAR(row.number("mean_balanced_accuracy"), sum / scored, 1e-6);
  }
  EXPECT_THAT(result.studies, Contains(HasSubstr("2 of 4: the others have no scored run")));
  EXPECT_THAT(result.studies,
              Contains(HasSubstr("Without a scored run, not in mean and worst: lost")));
  int named = 0;
  for (const FinishedRun& run : result.runs) {
    if (!run.failed()) continue;
    ++named;
    EXPECT_THAT(run.report.ending, HasSubstr(" s: ")) << "its time and its reason";
  }
  EXPECT_EQ(named, 2 * 2);
}

INSTANTIATE_TEST_SUITE_P(Forces, LostScene,
                         ::testing::Values("[0, 90, 0]", "[200, 0, 0]", "[0, 0, 1.0e9]"));

}  // namespace
}  // namespace touchdown::experiments
