#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "experiments/plan/plan.hpp"
#include "experiments/run_directory/directory.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// How a planned run went.
struct RunReport {
  recordings::Outcome outcome = recordings::Outcome::finished;
  double duration = 0.0;   ///< s
  int flights = 0;         ///< with both wheels off the ground, as long as scoring asks for
  std::string error = {};  ///< why there is no recording at all; its outcome is then `diverged`
};

/// Whether a run that ended so is of no use to a study.
inline bool is_failure(recordings::Outcome outcome) {
  return outcome == recordings::Outcome::fell || outcome == recordings::Outcome::diverged;
}

struct Rollout {
  PlannedRun plan;
  RunReport report;
  RunSignals signals;

  bool failed() const { return is_failure(report.outcome); }
};

/// Rollout runs by their index in the plan.
using Rollouts = std::map<std::size_t, Rollout>;

/// The test runs among them that are scored: all but those that failed.
std::vector<const RunSignals*> scored_runs(const std::vector<Rollout>& runs);

/// The test run with this index on this engine, null if there is none.
const Rollout* test_run(const std::vector<Rollout>& runs, const std::string& simulator,
                          std::int64_t index);

/// What happens to runs whose recording is not there.
enum class MissingRun : int { simulate, refuse };

/// Asked now and then; false stops the work with `Stopped`.
using ShouldContinue = std::function<bool()>;

/// Simulates planned runs in parallel and writes the recordings that are kept, or reads those that
/// are there already: which this build made of the same scenario, seed and run, and which are
/// whole. A run whose recording is not kept is simulated whatever `missing` says. A run that cannot
/// be simulated is a failed run and does not stop the others. Errors: `InputError` for a scene that
/// makes no sense; `Error` for a missing recording that is not to be simulated; `Stopped`.
Rollouts run_rollouts(const Experiment& experiment, const Plan& plan,
                     const std::set<std::size_t>& needed, const RunDirectory& directory,
                     MissingRun missing, const ShouldContinue& should_continue);

/// Given each run when it is played, with its index in the plan, by several threads at once.
using UseRollout = std::function<void(std::size_t index, Rollout run)>;

/// The same for many runs of which not all need be in memory at once. Errors: also those of `use`.
void for_each_rollout(const Experiment& experiment, const Plan& plan,
                     const std::set<std::size_t>& needed, const RunDirectory& directory,
                     MissingRun missing, const ShouldContinue& should_continue, const UseRollout& use);

/// Whether `run_rollouts` would find the run's recording, or the reason why it has none; true of a run
/// that keeps none.
bool is_recorded(const PlannedRun& run, const RunDirectory& directory);

/// Whether the run's recording was finished, without reading it.
bool has_stamp(const PlannedRun& run, const RunDirectory& directory);

}  // namespace touchdown::experiments
