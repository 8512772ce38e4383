#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/estimators/entry.hpp"
#include "experiments/estimators/fitted_model.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/plan/request.hpp"
#include "experiments/run_directory/store.hpp"
#include "experiments/signals/run_signals.hpp"
#include "noise/sensor_noise.hpp"
#include "scenarios/scenario.hpp"
#include "scoring/score.hpp"

namespace touchdown::scenarios {
class CompiledScenes;
}

namespace touchdown::experiments {

/// A test run with one noise realisation.
struct MeasuredRun {
  const RunSignals& signals;
  const NoiseRun& noise;
  int seed = 0;                         ///< number of the noise realisation
  std::vector<noise::NoiseCell> cells;  ///< the noise settings in which predictions are made
  const scoring::ScoringConfig& scoring;
};

/// The prediction of one condition for a test run in one noise setting.
struct MeasuredPrediction {
  const MeasuredRun& run;
  const Condition& condition;
  std::size_t cell = 0;  ///< index in the run's cells
  const scoring::Prediction& prediction;
};

/// What the tasks of a group of runs measure in addition to the scores of every experiment. A study
/// adds measures to its groups and reads their scores by name.
struct Measure {
  std::string name;  ///< unique in a group

  /// Scores of the run itself, and of each prediction: a packed list. An empty function or an empty
  /// text: nothing is measured there.
  std::function<std::string(const MeasuredRun&)> of_run = {};
  std::function<std::string(const MeasuredPrediction&)> of_prediction = {};
};

/// A measure of predictions with scores of one type, in a fixed order.
template <typename Score>
Measure measure_of_predictions(
    std::string name, std::function<std::vector<Score>(const MeasuredPrediction&)> of_prediction) {
  return {std::move(name),
          {},
          [of_prediction = std::move(of_prediction)](const MeasuredPrediction& prediction) {
            return pack(of_prediction(prediction));
          }};
}

enum class RunRole : int { fit, test };

std::string_view to_text(RunRole role);

/// A number of scenarios that is changed.
struct Change {
  std::string key = {};  ///< dotted, such as `terrain.friction`; empty: none
  double value = 0.0;    ///< in the key's own unit
};

/// What the runs of a group differ in from the experiment's own.
struct RunSetup {
  std::string fit = {};     ///< name of the fit; empty: the experiment's own
  std::string robot = {};   ///< file; empty: each scenario's own
  std::size_t sensors = 0;  ///< index in the plan's sensors
  Change change = {};
};

/// One run of an experiment, before it is simulated.
struct PlannedRun {
  RunRole role = RunRole::test;
  std::string simulator;
  scenarios::Scenario scenario;  ///< with its perturbations drawn
  std::int64_t run = 0;          ///< its index, unique within an engine and group
  std::string file;              ///< name of its recording
  std::uint64_t seed = 1;        ///< of its perturbations
  std::size_t group = 0;         ///< of test runs: index in the plan's groups
  std::size_t sensors = 0;       ///< of its signals: index in the plan's sensors
  std::string fit = {};          ///< of fitted runs: the name of their fit
  bool kept = true;              ///< whether its recording is kept
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

  /// The indices of the conditions that are tested on an engine.
  std::vector<std::size_t> tested_on(std::string_view simulator) const;
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

struct PlannedSensors {
  std::string name;  ///< unique; empty for the experiment's own
  noise::SensorProfile profile;
};

struct Plan {
  std::vector<PlannedSensors> sensors = {{}};  ///< the experiment's own first
  std::vector<PlannedRun> runs;                ///< by role (fit first), engine, scenario, index
  std::vector<RunGroup> groups;                ///< the experiment's own test runs first
  std::vector<Task> tasks;              ///< by test run in the order of the plan, then noise seed
  std::vector<ModelTasks> model_tasks;  ///< of studies
  std::map<std::string, int> refits;    ///< number of refits, by name of the fit
  std::set<std::int64_t> pictured;      ///< indices of own test runs that pictures show
  bool needs_motion = false;            ///< whether test runs keep their motion
  TaskRange all_tasks() const { return {0, tasks.size()}; }
  const RunGroup& group_of(const Task& task) const { return groups[runs[task.run].group]; }
  /// The tasks of a run, by noise seed.
  std::span<const Task> tasks_of(std::size_t run) const;
  /// The group of this name, if there is one.
  std::optional<std::size_t> group_called(std::string_view name) const;
  /// The model tasks of this name. Errors: `Error` if there are none.
  const ModelTasks& model_tasks_called(std::string_view name) const;
  /// The test runs of a group, of one engine or of all, in the order of the plan.
  std::vector<std::size_t> runs_in(std::size_t group, std::string_view simulator = {}) const;
};

/// The index of a test run's scenario in the experiment's test scenarios.
std::size_t scene_of(const PlannedRun& run, const Experiment& experiment);

/// The seed for drawing fitted runs.
std::uint64_t seed_of_fit(const Experiment& experiment);

/// The plan of the file's sections `fit`, `test`, `noise` and `highlights`.
Plan plan_of(const RunRequest& request);

/// Adds the runs of one role with this setup, in every engine. Test runs go to `group`. Errors:
/// `InputError` for a change that a scenario does not permit.
void plan_runs(const RunRequest& request, RunRole role, const RunSetup& setup, std::size_t group,
               Plan& plan);

/// The test runs of these tasks, and the runs of their estimators' fits.
std::set<std::size_t> runs_for(const Plan& plan, const TaskRange& tasks);

/// Sets which runs keep their recordings.
void keep_recordings(const Experiment& experiment, Plan& plan);

/// Adds the tasks of the test runs from index `first` on.
void plan_tasks(const Experiment& experiment, std::size_t first, Plan& plan);

/// Errors: `InputError` for a test run that is also a fitted run of the models it tests, and for a
/// run that would count twice, whatever the names of its scenario and of its robot's file; for two
/// groups of one name.
void require_distinct_runs(const Plan& plan, const Experiment& experiment);

}  // namespace touchdown::experiments
