#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/estimators/fitted_model.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/plan/measure.hpp"
#include "experiments/plan/request.hpp"
#include "noise/sensor_noise.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::experiments {

/// The purpose of a run.
enum class RunRole : int { fit, test };

/// "fit", "test".
std::string_view to_text(RunRole role);

/// A robot and its sensors, with a fit of their own.
struct RobotAndSensors {
  std::string fit = {};     ///< name of the fit; empty: the experiment's own
  std::string robot = {};   ///< file; empty: each scenario's own
  std::size_t sensors = 0;  ///< index in the plan's sensors
};

/// One run of an experiment, before it is simulated.
struct PlannedRun {
  RunRole role = RunRole::test;
  std::string simulator;
  scenarios::Scenario scenario;  ///< with its perturbations drawn
  std::int64_t run = 0;          ///< its index, unique within an engine and group
  std::string file;              ///< name of its recording
  std::uint64_t seed = 1;        ///< of its perturbations
  /// Of test runs: index in the plan's groups. Of fitted runs: 0 for fits to whole runs,
  /// `segment_group` for fits to segments.
  std::size_t group = 0;
  std::size_t sensors = 0;  ///< of its signals: index in the plan's sensors
  std::string fit = {};     ///< of fitted runs: the name of their fit
  bool kept = true;         ///< whether its recording is kept
};

/// Test runs with the same evaluation. Counts are computed for all conditions; scores and measures
/// need predictions, which are made for the conditions of `predicts`.
struct RunGroup {
  std::string name;                       ///< empty for the experiment's own test runs
  std::vector<Condition> conditions;      ///< of all engines
  std::vector<noise::NoiseCell> counted;  ///< settings with point-wise counts
  std::vector<noise::NoiseCell> scored;   ///< settings with predictions
  std::string fit = {};                ///< name of the in-domain fit; empty: the experiment's own
  bool scores_transfer = false;        ///< whether out-of-domain conditions are scored, too
  std::vector<Measure> measures = {};  ///< what studies measure in addition

  bool predicts(const Condition& condition) const {
    return scores_transfer || condition.is_in_domain(fit);
  }
  /// Refits are scored, but not counted.
  bool counts(const Condition& condition) const { return !counted.empty() && condition.refit == 0; }
};

/// Adds a measure, unless the group has one of this name.
void add_measure(Measure measure, RunGroup& group);

/// Work that needs fitted models and is no evaluation of a test run, such as runs in closed loop.
/// It is saved, distributed and resumed like tasks, item by item.
struct ModelTasks {
  std::string name;       ///< of its folder in the run directory's state
  std::string unit;       ///< of its items, for progress and file names: "run"
  std::size_t count = 0;  ///< of its items
  /// Computes one item. It is called by several threads. Errors: `Stopped`.
  std::function<std::string(std::size_t item, const FittedModels& models,
                            const std::function<bool()>& should_continue)>
      compute = {};
};

/// The unit in which an evaluation is computed, saved and distributed: one test run with one noise
/// realisation, for all conditions that are tested on its engine.
struct Task {
  std::size_t run = 0;  ///< index in the plan
  int seed = 0;         ///< number of the noise realisation
  noise::NoiseKey noise;
};

/// The tasks from `begin` to `end`.
struct TaskRange {
  std::size_t begin = 0;
  std::size_t end = 0;

  std::size_t size() const { return end - begin; }
};

/// A sensor model of runs.
struct PlannedSensors {
  std::string name;  ///< unique; empty for the experiment's own
  noise::SensorProfile profile;
};

/// The test runs that keep their signals after their evaluation, for studies and pictures.
enum class KeptSignals : int { none, own, all };

/// Everything that an experiment will compute.
struct Plan {
  std::vector<PlannedSensors> sensors = {{}};  ///< the experiment's own first
  std::vector<PlannedRun> runs;                ///< by role (fit first), engine, scenario, index
  std::vector<RunGroup> groups;                ///< the experiment's own test runs first
  std::vector<Task> tasks;              ///< by test run in the order of the plan, then noise seed
  std::vector<ModelTasks> model_tasks;  ///< of studies
  std::map<std::string, int> refits;    ///< number of refits, by name of the fit
  /// Fits to a part of the experiment's own training data: the size of the training set
  /// (experiments/rollouts/training_sets.hpp), by name of the fit. `refits` has an entry for each.
  std::map<std::string, std::size_t> training_sets;
  std::set<std::int64_t> pictured;  ///< indices of own test runs that pictures show
  bool needs_motion = false;        ///< whether test runs keep their motion
  KeptSignals kept_signals = KeptSignals::all;
  TaskRange all_tasks() const { return {0, tasks.size()}; }
  const RunGroup& group_of(const Task& task) const { return groups[runs[task.run].group]; }
  /// The group of this name, if there is one.
  std::optional<std::size_t> group_called(std::string_view name) const;
  /// The model tasks of this name. Errors: `Error` if there are none.
  const ModelTasks& model_tasks_called(std::string_view name) const;
  /// The test runs of a group, in the order of the plan.
  std::vector<std::size_t> runs_in(std::size_t group) const;
};

/// Whether a run is simulated when it is needed, and its signals are dropped as soon as they are
/// used: a fitted run, or a test run that does not keep them. False for all where a study needs
/// them.
bool is_streamed(const PlannedRun& run, const Plan& plan);

/// The group of the fitted runs for one entry of `fit.segments`.
constexpr std::size_t segment_group(std::size_t entry) { return 1 + entry; }

/// The index of a test run's scenario in the experiment's test scenarios.
std::size_t scene_of(const PlannedRun& run, const Experiment& experiment);

/// The seed for drawing fitted runs.
std::uint64_t seed_of_fit(const Experiment& experiment);

/// The plan of the file's sections `fit`, `test`, `noise` and `highlights`.
Plan plan_of(const RunRequest& request);

/// Adds the runs of one role with one robot and its sensors, in every engine. Test runs go to
/// `group`.
void plan_runs(const RunRequest& request, RunRole role, const RobotAndSensors& setup,
               std::size_t group, Plan& plan);

/// Adds the runs of training segments for one robot and its sensors, if an estimator learns from
/// segments.
void plan_segments(const RunRequest& request, const RobotAndSensors& setup, Plan& plan);

/// Adds the fitted runs from `first` to `end` of one entry of `fit.segments`, in every engine.
void plan_segment_runs(const RunRequest& request, const RobotAndSensors& setup, std::size_t entry,
                       int first, int end, Plan& plan);

/// The test runs of these tasks, and the runs of their estimators' fits.
std::set<std::size_t> runs_for(const Plan& plan, const TaskRange& tasks);

/// Sets which runs keep their recordings.
void keep_recordings(const Experiment& experiment, Plan& plan);

/// Adds the tasks of the test runs from index `first` on.
void plan_tasks(const Experiment& experiment, std::size_t first, Plan& plan);

}  // namespace touchdown::experiments
