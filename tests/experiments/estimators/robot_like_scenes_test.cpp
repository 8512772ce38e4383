#include <map>
#include <string>

#include <gtest/gtest.h>

#include "experiments/run_experiment.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "scenarios/scenario_file.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

/// A shorter copy of a shipped scenario.
std::string shortened(const ScratchFolder& folder, const std::string& name) {
  YamlDocument document = YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/scenarios/" + name + ".yaml");
  document.override_value("end.duration=8");
  return folder.write(name + ".yaml", scenarios::to_yaml(scenarios::scenario_from_yaml(document)))
      .string();
}

struct Recall {
  double contact = 0.0;
  double air = 0.0;
  double mean() const { return 0.5 * (contact + air); }
};

/// Recall of every estimator on scenes with the torques of the real robot, by torque noise.
std::map<std::string, std::map<double, Recall>> recall_on_robot_like_scenes(
    const std::string& sensors) {
  const ScratchFolder folder;
  const std::string scenes =
      "[" + shortened(folder, "roam_crouching") + ", " + shortened(folder, "hang_crouching") + "]";
  const Experiment experiment = experiment_from_yaml(
      YamlDocument::parse("name: robot_like\nseed: 4\nsimulators: [mujoco]\n"
                          "estimators: [robust, measurement_only, paper]\n"
                          "fit: {scenarios: " +
                              scenes +
                              ", runs: 3}\n"
                              "test: {scenarios: " +
                              scenes + ", runs: 3}\n" + sensors +
                              "noise: {torque: [0.0, 0.25, 1.0], accelerometer: [0.0]}\n"
                              "recordings: none\nvideo: {enabled: false}\n",
                          "robot_like.yaml"));
  const ExperimentResult result =
      run_experiment(experiment, {.out = folder / "run", .command = "test"});
  std::map<std::string, std::map<double, Recall>> recall;
  for (const CellSummary& summary : result.summaries) {
    recall[summary.condition.estimator][summary.cell.torque] = {summary.contact_recall.estimate,
                                                                summary.no_contact_recall.estimate};
  }
  return recall;
}

TEST(RobotLikeScenes, AreNotHarderForRobustThanForThePapersFilter) {
  for (const char* sensors : {"sensors: " TOUCHDOWN_SOURCE_DIR "/sensors/upkie.yaml\n", ""}) {
    auto recall = recall_on_robot_like_scenes(sensors);
    for (const char* name : {"robust", "measurement_only"}) {
      const Recall without_noise = recall[name][0.0];
      EXPECT_GE(without_noise.mean(), recall["paper"][0.0].mean() - 0.01) << name << ' ' << sensors;
      EXPECT_GT(without_noise.contact, 0.9) << name << ' ' << sensors;
      EXPECT_GT(without_noise.air, 0.98) << name << ' ' << sensors;
      // Densities of the fitted runs alone would take noise for contact.
      EXPECT_GT(recall[name][0.25].air, 0.9) << name << ' ' << sensors;
      EXPECT_GT(recall[name][1.0].air, 0.8) << name << ' ' << sensors;
      EXPECT_LT(recall["paper"][0.25].air, 0.1) << sensors;
    }
  }
}

}  // namespace
}  // namespace touchdown::experiments
