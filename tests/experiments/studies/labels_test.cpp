#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "core/files.hpp"
#include "core/table.hpp"
#include "experiments/run_experiment.hpp"
#include "logs/log/recording_file.hpp"
#include "tests/experiments/small_step_scene.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

class LabelSensitivity : public ::testing::Test {
 protected:
  ExperimentResult run() {
    Experiment experiment;
    experiment.name = "labels";
    experiment.simulators = {"mujoco"};
    experiment.estimators = {"oracle"};
    const std::string file = folder_.write("small_step.yaml", small_step_scene).string();
    experiment.fit.scenarios = {file};
    experiment.test.scenarios = {file};
    experiment.test.runs = 2;
    experiment.noise.torque = {0.5};
    experiment.noise.accelerometer = {1.0};
    experiment.noise.seeds = 1;
    experiment.highlights = {{0.5, 1.0}};
    experiment.video.enabled = false;
    experiment.paper_tables = true;
    experiment.recordings = KeptRecordings::all;
    return run_experiment(experiment, {folder_ / "out", "", nullptr});
  }

  /// Share of steps with a force above `threshold` (N) on the wheel, after the first 300 ms.
  static double contact_share(const ExperimentResult& result, double threshold) {
    double in_contact = 0.0;
    double all = 0.0;
    for (const FinishedRun& rollout : result.runs) {
      if (rollout.plan.role != RunRole::test) continue;
      const logs::Recording recording =
          logs::read_recording(result.directory.file("recordings", rollout.plan.file));
      for (std::size_t k = 300; k < recording.steps(); ++k) {
        for (const double force : recording.truth[k].wheel_normal_force) {
          in_contact += force > threshold ? 1.0 : 0.0;
          all += 1.0;
        }
      }
    }
    return in_contact / all;
  }

  const ScratchFolder folder_;
};

TEST_F(LabelSensitivity, CountsTheSameDecisionsAgainstEveryDefinitionOfTheTruth) {
  const ExperimentResult result = run();
  const TextTable table = from_csv(read_file(result.directory.file("tables", "labels.csv")));
  ASSERT_EQ(table.header[4], "success");
  std::map<std::string, double> success;  // by estimator, share, window
  for (const auto& row : table.rows) {
    success[row[1] + " " + row[2] + " " + row[3]] = std::stod(row[4]);
  }
  ASSERT_EQ(success.size(), 2U * 16U);
  // The accuracy of always contact is the share of contact.
  for (const std::string share : {"0.0019", "0.019", "0.095", "0.19"}) {
    constexpr double weight = 5.33922 * 9.81;  // Upkie's, N
    EXPECT_NEAR(success.at("always_contact " + share + " 0"),
                contact_share(result, std::stod(share) * weight), 5e-5)
        << share;
  }
  EXPECT_LT(success.at("always_contact 0.19 0"), success.at("always_contact 0.0019 0"));
  // The oracle uses the experiment's own definition, which is one of the sixteen.
  EXPECT_DOUBLE_EQ(success.at("oracle 0.019 0.01"), 1.0);
  EXPECT_LT(success.at("oracle 0.19 0"), 1.0);
}

}  // namespace
}  // namespace touchdown::experiments
