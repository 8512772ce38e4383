#include <gtest/gtest.h>

#include "experiments/estimators/registry.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "noise/grid.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

constexpr const char* file =
    "name: encoders\n"
    "fit: {scenarios: [stairs.yaml]}\n"
    "test: {scenarios: [stairs.yaml]}\n"
    "noise: {torque: [0, 1], knee_wheel: {knee: [0, 2], wheel: [0, 2]}, joint_position: 0.01, "
    "joint_velocity: 0.5}\n"
    "highlights: [{torque: 1, accelerometer: 0}]\n";

TEST(EncoderNoise, IsReadKeptAndPartOfEveryCell) {
  const Experiment experiment = experiment_from_yaml(YamlDocument::parse(file, "file"));
  const Experiment again = experiment_from_yaml(YamlDocument::parse(to_yaml(experiment), "again"));
  for (const Experiment& e : {experiment, again}) {
    std::vector<noise::NoiseCell> cells = noise::noise_cells(e.noise);
    cells.insert(cells.end(), e.highlights.begin(), e.highlights.end());
    ASSERT_EQ(cells.size(), 2U + 3U + 1U);
    for (const noise::NoiseCell& cell : cells) {
      EXPECT_EQ(cell.levels().joint_position, 0.01);
      EXPECT_EQ(cell.levels().joint_velocity, 0.5);
    }
  }
}

TEST(EncoderNoise, MayNotBeNegative) {
  std::string text = file;
  text.replace(text.find("0.01"), 4, "-0.1");
  EXPECT_THROW(experiment_from_yaml(YamlDocument::parse(text, "file")), InputError);
}

/// Encoder noise changes estimators that use joint states, and no others.
TEST(EncoderNoise, ChangesOnlyEstimatorsThatUseEncoders) {
  const RunSignals run = synthetic_run(3);
  const Experiment experiment = synthetic_experiment(estimator_names());
  const FittedModels models = fit_models(experiment, pointers_to({synthetic_run(first_fit_run)}));
  const NoiseRun noise = noise_run(run, noise_key(experiment, 0, 3));
  for (const std::string& name : estimator_names()) {
    const auto estimator = make_estimator(experiment, {"mujoco", "mujoco", name}, models, run);
    const auto exact = predict(*estimator, run, noise, {});
    const auto noisy =
        predict(*estimator, run, noise, {.joint_position = 0.3, .joint_velocity = 30.0});
    const bool changed = exact[0].p_contact != noisy[0].p_contact;
    const Sensors& sensors = estimator_entry(name).sensors;
    EXPECT_EQ(changed, sensors.joint_position || sensors.joint_velocity) << name;
  }
}

}  // namespace
}  // namespace touchdown::experiments
