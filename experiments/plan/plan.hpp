#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/plan/condition.hpp"
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

/// A noise setting with a further disturbance.
struct DisturbedCell {
  noise::NoiseCell cell;
  noise::Disturbance disturbance;
};

/// Test runs with the same evaluation. Only counts are computed for all conditions; all other
/// scores are for in-domain conditions, see `scores`.
struct RunGroup {
  std::string name;                           ///< empty for the experiment's own test runs
  std::vector<Condition> conditions;          ///< of all engines
  std::vector<noise::NoiseCell> counted;      ///< settings with point-wise counts
  std::vector<noise::NoiseCell> scored;       ///< settings with all scores
  std::vector<DisturbedCell> disturbed = {};  ///< additional settings with counts
  bool has_extended_scores = false;  ///< whether scored settings also get an `ExtendedScore`
  std::string fit = {};              ///< name of the in-domain fit; empty: the experiment's own
  bool scores_transfer = false;      ///< whether out-of-domain conditions are scored, too
  /// If set: in-domain conditions are contact sources of odometry, in the first scored setting.
  std::optional<OdometryStudyConfig> odometry = {};

  /// If set: in-domain conditions are also scored at these thresholds, in every scored setting.
  std::optional<OperatingPointsConfig> operating_points = {};

  bool scores(const Condition& condition) const {
    return scores_transfer || condition.is_in_domain(fit);
  }
  bool feeds_odometry(const Condition& condition) const {
    return odometry && condition.is_fitted_in_domain(fit);
  }
  bool tries_points(const Condition& condition) const {
    return operating_points && condition.is_fitted_in_domain(fit);
  }
  /// Refits are scored, but not counted.
  bool counts(const Condition& condition) const { return !counted.empty() && condition.refit == 0; }
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

/// Everything that an experiment will compute.
struct Plan {
  std::vector<PlannedSensors> sensors = {{}};  ///< the experiment's own first
  std::vector<PlannedRun> runs;                ///< by role (fit first), engine, scenario, index
  std::vector<RunGroup> groups;                ///< the experiment's own test runs first
  std::vector<Task> tasks;  ///< by test run in the order of the plan, then noise seed

  TaskRange all_tasks() const { return {0, tasks.size()}; }
  const RunGroup& group_of(const Task& task) const { return groups[runs[task.run].group]; }
  /// The group of this name, if there is one.
  std::optional<std::size_t> group_called(std::string_view name) const;
  /// The test runs of a group, in the order of the plan.
  std::vector<std::size_t> runs_in(std::size_t group) const;
};

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
