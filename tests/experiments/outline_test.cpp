#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/files.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/run_experiment.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

RunOutline outline(const Experiment& experiment, const ScratchFolder& folder) {
  return outline_of(experiment, {.out = folder / "run", .command = "test"});
}

TEST(NightlyOutline, CountsTheRunsAndPartsOfEveryShippedExperimentAndWritesNothing) {
  const ScratchFolder folder;
  int experiments = 0;
  for (const std::filesystem::path& file : entries_in(TOUCHDOWN_SOURCE_DIR "/experiments")) {
    if (file.extension() != ".yaml") continue;
    const std::string name = file.stem().string();
    if (name.starts_with("nmn")) continue;  // how a network is trained
    Experiment experiment =
        experiment_from_yaml(completed(YamlDocument::load(file), YamlKind::experiment));
    constexpr std::size_t most = 22;  // of hundreds of drawn scenes, one of each family
    for (RunsConfig* runs : {&experiment.fit, &experiment.test}) {
      runs->scenarios.resize(std::min(runs->scenarios.size(), most));
    }
    const RunOutline outline = experiments::outline(experiment, folder);
    const auto runs = [&](const RunsConfig& config) {
      return experiment.simulators.size() * config.scenarios.size() *
             static_cast<std::size_t>(config.runs);
    };
    // Studies add runs with other robots and sensors, and of scenes of their own.
    EXPECT_GE(outline.test_runs, runs(experiment.test)) << name;
    EXPECT_GE(outline.fitted_runs, runs(experiment.fit)) << name;
    EXPECT_EQ(outline.tasks, outline.test_runs * static_cast<std::size_t>(experiment.noise.seeds))
        << name;
    EXPECT_GT(outline.simulated, 0.0) << name;
    EXPECT_EQ(outline.model_tasks.empty(), !name.starts_with("closed_loop")) << name;
    ++experiments;
  }
  EXPECT_GT(experiments, 12);
  EXPECT_FALSE(std::filesystem::exists(folder / "run"));
}

TEST(Outline, CountsOneSimulationForRunsThatDifferInTheirSensors) {
  const ScratchFolder folder;
  const RunOutline plain =
      outline(experiment_from_yaml(YamlDocument::load(folder.write(
                  "plain.yaml",
                  "name: plain\nestimators: [robust]\n"
                  "fit: {scenarios: [scenarios/stairs.yaml], runs: 1}\n"
                  "test: {scenarios: [scenarios/hop.yaml], runs: 3}\nnoise: {seeds: 5}\n"))),
              folder);
  EXPECT_EQ(plain.fitted_runs, 2U);  // two engines
  EXPECT_EQ(plain.test_runs, 6U);
  EXPECT_EQ(plain.tasks, 30U);
  const RunOutline wide =
      outline(experiment_from_yaml(YamlDocument::load(folder.write(
                  "wide.yaml",
                  "name: wide\nestimators: [robust]\n"
                  "fit: {scenarios: [scenarios/stairs.yaml], runs: 1}\n"
                  "test: {scenarios: [scenarios/hop.yaml], runs: 3}\nnoise: {seeds: 5}\n"
                  "benchmark: {sensors: [noise/profiles/upkie.yaml]}\n"))),
              folder);
  EXPECT_EQ(wide.fitted_runs, 4U);
  EXPECT_EQ(wide.test_runs, 12U);
  EXPECT_EQ(wide.tasks, 60U);
  EXPECT_DOUBLE_EQ(wide.simulated, plain.simulated);
}

}  // namespace
}  // namespace touchdown::experiments
