#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "experiments/evaluation/tune.hpp"
#include "experiments/experiment_context.hpp"
#include "experiments/plan/plan.hpp"
#include "experiments/plan/rollouts.hpp"

namespace touchdown::experiments {

/// The stages of an experiment; experiments/run_experiment.cpp puts them in order. The sources are
/// experiments/simulate.cpp, fit.cpp, evaluate.cpp and summarize.cpp. Each stage reads what is
/// saved and computes the rest, so that a resumed run, a shard and a merge are the same calls.
/// Errors of all stages: `Stopped`.

/// The tasks that are not evaluated yet, and the fits that they need. Fits are made one after the
/// other. Tasks can be evaluated as soon as their fits are there; tasks that share a simulation
/// only together, or it would run twice.
class PendingTasks {
 public:
  PendingTasks(const Plan& plan, const TaskRange& tasks);

  /// Removes and returns the tasks with all their fits among `models`, as indices in the plan.
  std::vector<std::size_t> take_ready(const FittedModels& models);
  std::vector<std::size_t> take_all();

  /// Whether a task that is left needs the fit with this key.
  [[nodiscard]] bool needs(const std::string& model_key) const;

 private:
  struct Simulation {
    std::vector<std::size_t> tasks;
    std::set<std::string> fits;  ///< keys
  };
  std::vector<Simulation> simulations_;
};

/// A share of an experiment's tasks, and what the stages have computed for it so far.
struct Computed {
  Computed(const Plan& plan, const TaskRange& of_plan, MissingRun if_missing);

  TaskRange share;
  MissingRun missing;  ///< what to do with simulations and results that are not saved
  /// The runs that the share needs, as indices in the plan. Those that are held are simulated
  /// first, and their signals stay in memory. Those that are streamed are simulated when they are
  /// needed, and only their reports stay.
  std::set<std::size_t> held = {};
  std::set<std::size_t> streamed = {};
  PendingTasks pending;
  bool is_shard = false;  ///< whether other processes compute the other tasks

  Rollouts runs = {};
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

// Simulation

/// Simulates the runs that are held, or reads their recordings. Errors: those of `FitRunCheck`.
void simulate(ExperimentContext& context, Computed& done);

/// Simulates runs and holds their signals. Errors: those of `FitRunCheck`.
Rollouts hold_rollouts(const ExperimentContext& context, const std::set<std::size_t>& wanted,
                       MissingRun missing);

/// Keeps of a run what tables need, and frees its signals.
void drop_signals(Rollout& run);

/// Notices that fitted runs lack flights or contact as soon as the last of them is simulated, which
/// is before most test runs are. It cannot be known earlier: whether a robot leaves the ground is a
/// result of the simulation.
class FitRunCheck {
 public:
  /// `needed`: the runs that will be simulated, by their index in the plan.
  FitRunCheck(const Experiment& experiment, const Plan& plan, const std::set<std::size_t>& needed);

  /// Called once for each simulated run, from several threads. Errors: `InputError` with the
  /// estimators that cannot be fitted, what the runs lack, and the scenes; or with the reason of
  /// the first failure if all runs failed.
  void add(const Rollout& run);

 private:
  /// The whole runs of one fit on one engine.
  struct Runs {
    std::size_t left = 0;                  ///< not simulated yet
    std::array<bool, 3> has_contact = {};  ///< of so many wheels, at any step
    bool is_any_usable = false;
    std::set<std::string> scenes = {};
    std::map<std::string, std::string> failures = {};  ///< endings by file
  };

  std::vector<std::string> fitted_estimators_;
  std::map<std::pair<std::string, std::string>, Runs> fits_;  ///< by name of the fit and engine
  std::mutex mutex_;
};

// Tuning and fits

/// One fit on one engine; `name` is empty for the experiment's own fit.
struct NeededFit {
  std::string engine;
  std::string name;
};

/// The fits that the evaluation of the share needs, in the order of the plan; none if no run can be
/// scored.
std::vector<NeededFit> needed_fits(const ExperimentContext& context, const Computed& done);

/// Tunes hyperparameters, and makes one fit with its refits. A fit without a tuning of its own uses
/// the choices of the experiment's own fit. Streamed fitted runs are simulated for it.
void tune_and_fit(ExperimentContext& context, const NeededFit& fit, Computed& done);

// Evaluation

/// If runs are streamed, evaluates the tasks with fits that are all there, and frees models that no
/// other task needs, so that memory need not hold all models. Otherwise it leaves all tasks to
/// `evaluate_rest`, which evaluates more of them in parallel.
void evaluate_ready(ExperimentContext& context, Computed& done);

void evaluate_rest(ExperimentContext& context, Computed& done);

/// Computes the share's model tasks (`Plan::model_tasks`).
void run_model_tasks(ExperimentContext& context, const Computed& done);

// Results

/// Errors: `Error` with the reasons if no test run can be scored.
void require_scored_run(const Rollouts& runs);

/// Scores with intervals, and the studies.
ExperimentResult score(ExperimentContext& context, Computed& done);

/// Logs that a reserved seed was used, and adds a text about it.
void log_reserved_seed(ExperimentResult& result);

/// Writes tables, models and the manifest, which make the run directory complete.
void write_result(const ExperimentContext& context, Computed& done, ExperimentResult& result);

}  // namespace touchdown::experiments
