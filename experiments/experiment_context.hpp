#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>

#include <tbb/global_control.h>

#include "experiments/studies/closed_loop/rollout.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/results/result.hpp"

namespace touchdown::experiments {

/// How an experiment is run; none of it changes a result.
struct RunOptions {
  std::filesystem::path out;                ///< run directory; empty: by the experiment's content
  std::string command;                      ///< what was typed, for the manifest
  const std::atomic<bool>* stop = nullptr;  ///< becomes true when the user asks to stop
  bool overwrite = false;  ///< another experiment that is in the run directory is replaced
};

/// What every step of an experiment works with. While it lives, it limits the number of threads to
/// what the experiment asks for.
struct ExperimentContext {
  RunRequest request;
  RunDirectory directory;
  Plan plan;
  SavedCounts saved;
  SavedClosedLoops saved_closed_loops;
  ShouldContinue should_continue;
  Provenance provenance;
  tbb::global_control limit;
};

/// What the file's sections ask for, studies included.
Plan whole_plan(const RunRequest& request);

ExperimentContext start(RunRequest request, RunDirectory directory, const RunOptions& options);

/// Does one step and notes the time that it took.
template <typename Step>
auto timed(ExperimentContext& context, const char* name, const Step& step) {
  const auto start = std::chrono::steady_clock::now();
  auto result = step();
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  context.provenance.timings.emplace_back(name, elapsed.count());
  return result;
}

/// How much of it is saved, for people who stopped it.
std::string what_is_saved(const ExperimentContext& context);

/// Errors: `InputError` that names the shards whose tasks are not saved.
void require_all_shards(const ExperimentContext& context);

}  // namespace touchdown::experiments
