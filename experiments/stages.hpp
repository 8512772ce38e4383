#pragma once

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
/// experiments/simulate.cpp, fit.cpp and evaluate.cpp.

/// The runs that a share of the tasks needs, as indices in the plan.
struct NeededRuns {
  std::set<std::size_t> held;      ///< simulated first; their signals stay in memory
  std::set<std::size_t> streamed;  ///< simulated when they are needed, then dropped
};

/// What the stages have computed so far.
struct Computed {
  Rollouts runs;
  FittedModels models;
  std::vector<Trial> trials;  ///< of tuning, by fit, then engine
  std::size_t tasks = 0;      ///< tasks that were not saved already
};

// Simulation

/// The test runs of these tasks and the runs of their fits; also the fitted runs of the
/// experiment's own models if this share has model tasks.
NeededRuns needed_runs(const ExperimentContext& context, const TaskRange& tasks);

/// Simulates runs, or reads their recordings, and holds their signals. Those for training segments
/// hold only their segments. Errors: those of `FitRunCheck`; `Stopped`.
Rollouts hold_rollouts(const ExperimentContext& context, const std::set<std::size_t>& wanted,
                       MissingRun missing);

/// Keeps of a run what tables need, and frees its signals.
void drop_signals(Rollout& run);

/// Notices that fitted runs lack flights or contact as soon as the last of them is simulated, which
/// is before most test runs are. It cannot be known earlier: whether a robot leaves the ground is a
/// result of the simulation. It checks the fits of phase and measurement models; the fits
/// themselves check more.
class FitRunCheck {
 public:
  /// `needed`: the runs that will be simulated, by their index in the plan.
  FitRunCheck(const Experiment& experiment, const Plan& plan, const std::set<std::size_t>& needed);

  /// Called once for each simulated run, from several threads. Errors: `InputError` with the
  /// estimators that cannot be fitted, what the runs lack, and the scenes; or with the reason of
  /// the first failure if all runs failed.
  void add(const Rollout& run);

 private:
  /// What the runs of a fit contain at any step.
  struct Contents {
    bool contact = false;     ///< of a wheel
    bool no_contact = false;  ///< of a wheel
    bool rolling = false;     ///< both wheels in contact
    bool flight = false;      ///< no wheel in contact
  };
  /// The whole runs of one fit on one engine.
  struct Runs {
    std::size_t left = 0;  ///< not simulated yet
    Contents contents = {};
    bool is_any_usable = false;
    std::set<std::string> scenes = {};
    std::map<std::string, std::string> failures = {};  ///< endings by file
  };

  static void require(bool holds, const std::vector<std::string>& estimators,
                      const std::string& missing, const std::string& simulator, const Runs& runs);

  std::vector<std::string> whole_run_estimators_;  ///< fitted, and not to segments
  std::vector<std::string> phase_estimators_;
  std::vector<std::string> measurement_estimators_;
  std::map<std::pair<std::string, std::string>, Runs> fits_;  ///< by name of the fit and engine
  std::mutex mutex_;
};

// Tuning and fits

/// The engines and the names of the fits that the evaluation of these runs needs, both in the order
/// of the plan; none if no run can be scored.
struct NeededFits {
  std::vector<std::string> engines;
  std::vector<std::string> names;
};
NeededFits needed_fits(const ExperimentContext& context, const NeededRuns& needed,
                       const Rollouts& runs);

/// Tunes hyperparameters, and makes one fit on one engine, with its refits. A fit without a tuning
/// of its own uses the choices of the experiment's own fit. Streamed fitted runs are simulated for
/// it, and only their reports remain.
void tune_and_fit(const ExperimentContext& context, const NeededRuns& needed,
                  const std::string& engine, const std::string& fit, MissingRun missing,
                  Computed& done);

/// The fits to the plan's training sets, each with its refits. Errors: `InputError`, with the size
/// of the set, when one does not suffice for a fit; `Stopped`.
void fit_training_sets(const ExperimentContext& context, const NeededFits& fits, Computed& done);

// Evaluation

/// The tasks that are not evaluated yet, and the fits that they need. Fits are made one after the
/// other. Tasks can be evaluated as soon as their fits are there; tasks that share a simulation
/// only together, or it would run twice.
class PendingTasks {
 public:
  PendingTasks(const Plan& plan, const TaskRange& tasks);

  /// Removes and returns the tasks with all their fits among `models`, as indices in the plan.
  std::vector<std::size_t> take_ready(const FittedModels& models);
  /// Removes and returns all tasks that are left.
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

/// Evaluates these tasks unless they are saved. Streamed test runs are simulated for it, and only
/// their reports remain.
void evaluate(const ExperimentContext& context, const NeededRuns& needed,
              const std::vector<std::size_t>& tasks, MissingRun missing, Computed& done);

/// Writes and frees the phase models, which are large, of fits that neither tasks nor pictures need
/// any more.
void release_phase_models(const ExperimentContext& context, const PendingTasks& pending,
                          const TaskRange& tasks, FittedModels& models);

}  // namespace touchdown::experiments
