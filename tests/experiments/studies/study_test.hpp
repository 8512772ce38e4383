#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/files.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/plan/rollouts.hpp"
#include "experiments/run_directory/shard.hpp"
#include "experiments/run_experiment.hpp"
#include "scenarios/engine.hpp"
#include "tests/experiments/small_step_scene.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {

/// The signals of a run with ideal sensors, simulated once more.
inline RunSignals signals_of(const FinishedRun& run, const Experiment& experiment) {
  const PlannedRun& plan = run.plan;
  logs::Recording recording = scenarios::play(plan.scenario, plan.simulator, plan.seed, plan.run);
  return reported_signals({}, experiment, *scenarios::CompiledScenes().as_described(plan.scenario),
                          recording);
}

/// Runs an experiment in `<folder>/<name>`.
inline ExperimentResult run_in(const ScratchFolder& folder, const Experiment& experiment,
                               const std::string& name = "run") {
  RunOptions options;
  options.out = folder / name;
  return run_experiment(experiment, options);
}

/// Runs an experiment as a whole and in shards, and expects equal files.
inline void expect_same_in_shards(const ScratchFolder& folder, const Experiment& experiment,
                                  int shards, const std::vector<std::string>& files) {
  run_in(folder, experiment, "whole");
  RunOptions options;
  options.out = folder / "shards";
  for (int shard = shards; shard > 0; --shard) {
    run_shard(experiment, Shard{shard, shards}, options);
  }
  finish_run(folder / "shards", options);
  for (const std::string& file : files) {
    EXPECT_EQ(read_file(folder / "whole" / file), read_file(folder / "shards" / file)) << file;
  }
}

/// An experiment as it is written, which reads back to the same text.
inline std::string reread_yaml(const Experiment& experiment) {
  std::string text = to_yaml(experiment);
  EXPECT_EQ(to_yaml(experiment_from_yaml(YamlDocument::parse(text, "again.yaml"))), text);
  return text;
}

}  // namespace touchdown::experiments
