#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "experiments/evaluation/tune.hpp"
#include "experiments/experiment_context.hpp"
#include "experiments/plan/plan.hpp"
#include "experiments/plan/rollouts.hpp"

namespace touchdown::experiments {

/// The stages of an experiment; experiments/run_experiment.cpp puts them in order. The sources are
/// experiments/fit.cpp, evaluate.cpp and summarize.cpp. Each stage asks the store for what is saved
/// and computes the rest, so that a resumed run and a shard are the same calls. Signals of
/// a run are in memory only while it is used. Errors of all stages: `Stopped`.

/// A share of an experiment's tasks, and what the stages have found for it so far.
struct Computed {
  TaskRange share;
  bool is_shard = false;  ///< whether other processes compute the other tasks

  FinishedRuns runs = {};  ///< the share's test runs, and those of their fits
  FittedModels models = {};
  std::vector<Trial> trials = {};  ///< of tuning, by fit, then engine
  std::size_t tasks = 0;           ///< tasks that were not saved already
};

/// Adds the time from its creation to its destruction to the stage of this name.
class StageTimer {
 public:
  StageTimer(ExperimentContext& context, const char* stage) : context_(context), stage_(stage) {}
  ~StageTimer();
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  ExperimentContext& context_;
  const char* stage_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Makes the fits that the evaluation of the share needs, with their tuning and refits, one after
/// the other: the runs of one fit at a time are in memory. A fit without a tuning of its own uses
/// the choices of the experiment's own fit. Errors: those of `require_fittable`.
void fit(ExperimentContext& context, Computed& done);

/// Errors: `InputError` with the estimators that cannot be fitted, what their runs lack, and the
/// scenes; or with the reason of the first failure if all runs failed. Whether a robot leaves the
/// ground is a result of the simulation, so that it cannot be known earlier.
void require_fittable(const Experiment& experiment, const std::vector<Rollout>& fitted_runs);

/// Simulates the test runs of the share's tasks that are not saved, evaluates each at once, and
/// saves the results.
void evaluate(ExperimentContext& context, Computed& done);

/// Computes the share's model tasks (`Plan::model_tasks`).
void run_model_tasks(ExperimentContext& context, const Computed& done);

/// Errors: `Error` with the reasons if no test run can be scored.
void require_scored_run(const FinishedRuns& runs);

/// Scores with intervals, and the studies.
ExperimentResult score(ExperimentContext& context, Computed& done);

/// Logs that a reserved seed was used, and adds a text about it.
void log_reserved_seed(ExperimentResult& result);

/// Writes tables, models and the manifest, which make the run directory complete.
void write_result(const ExperimentContext& context, Computed& done, ExperimentResult& result);

}  // namespace touchdown::experiments
