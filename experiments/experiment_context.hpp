#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include <tbb/global_control.h>

#include "experiments/evaluation/tasks.hpp"
#include "experiments/results/result.hpp"

namespace touchdown::experiments {

/// How an experiment is run. No option changes a result.
struct RunOptions {
  std::filesystem::path out;  ///< run directory; empty: named after the experiment's content
  std::string command;        ///< the command line, for the manifest
  const std::atomic<bool>* stop = nullptr;  ///< set to true when the user asks to stop
  bool overwrite = false;                   ///< replaces another experiment in the run directory
};

/// The state that all steps of an experiment share. While it lives, it limits the number of threads
/// to the experiment's `workers`.
struct ExperimentContext {
  RunRequest request;
  RunDirectory directory;
  Plan plan;
  ShouldContinue should_continue;
  Provenance provenance;
  tbb::global_control limit;
};

/// Plans everything that the experiment file asks for, its studies included. Errors: `InputError`
/// for a wrong request; `Error` for too little memory.
Plan whole_plan(const RunRequest& request);

/// Begins an experiment with a plan that was made before the directory.
ExperimentContext start(RunRequest request, Plan plan, RunDirectory directory,
                        const RunOptions& options);

/// Locks a run directory of this build, and begins its experiment once more. Errors: those of
/// `read_request`, `whole_plan` and `start`.
ExperimentContext reopened(const std::filesystem::path& run_directory, const RunOptions& options);

/// A message for the user who stopped the experiment: how much of it is saved.
std::string what_is_saved(const ExperimentContext& context);

}  // namespace touchdown::experiments
