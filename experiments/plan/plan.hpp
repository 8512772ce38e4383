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

/// What a run is for.
enum class RunRole : int { fit, test };

/// "fit", "test".
std::string_view to_text(RunRole role);

/// A robot and its sensors, to which estimators are fitted.
struct RobotAndSensors {
  std::string fit = {};     ///< the name of that fit; empty: the experiment's own
  std::string robot = {};   ///< file; empty: each scenario's own
  std::size_t sensors = 0;  ///< index in the plan's
};

/// One run that an experiment asks for.
struct PlannedRun {
  RunRole role = RunRole::test;
  std::string simulator;
  scenarios::Scenario scenario;  ///< as it will be played: perturbations drawn
  std::int64_t run = 0;          ///< its index, different for every run of one engine and group
  std::string file;              ///< name of its recording
  std::uint64_t seed = 1;        ///< that its perturbations are drawn with
  /// Of test runs: index in the plan's groups. Of fitted ones: 0 for those that are fitted whole,
  /// `segment_group` for those that are fitted in pieces.
  std::size_t group = 0;
  std::size_t sensors = 0;  ///< that it is heard through: index in the plan's
  std::string fit = {};     ///< of fitted runs: the name of the fit that they are for
  bool kept = true;         ///< whether its recording stays
};

/// A noise setting with something besides noise.
struct DisturbedCell {
  noise::NoiseCell cell;
  noise::Disturbance disturbance;
};

/// Test runs that are listened to alike. What is more than counts is for the conditions that were
/// fitted where they are tested.
struct RunGroup {
  std::string name;                           ///< empty for the experiment's own test runs
  std::vector<Condition> conditions;          ///< of all engines
  std::vector<noise::NoiseCell> counted;      ///< settings in which every condition is counted
  std::vector<noise::NoiseCell> scored;       ///< settings that are scored in full
  std::vector<DisturbedCell> disturbed = {};  ///< settings that are counted besides
  bool has_extended_scores = false;          ///< whether scored settings get a `ExtendedScore` too
  std::string fit = {};  ///< the name of the fit that is at home here; empty: the experiment's own
  bool scores_transfer = false;  ///< whether conditions that were fitted elsewhere are scored as well
  /// Whether those at home tell odometry about contact, in the first scored setting.
  std::optional<OdometryStudyConfig> odometry = {};

  /// Whether those at home decide by other thresholds, too, in every scored setting.
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
  /// A refit is scored alone.
  bool counts(const Condition& condition) const { return !counted.empty() && condition.refit == 0; }
};

/// The unit in which an experiment's listening is computed, saved and spread over machines: one
/// test run through one noise realisation, heard by all conditions that are tested on its engine.
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

/// Sensors that runs are heard through.
struct PlannedSensors {
  std::string name;  ///< different for each; empty for the experiment's own
  noise::SensorProfile profile;
};

/// Everything that an experiment is going to do, before anything is done.
struct Plan {
  std::vector<PlannedSensors> sensors = {{}};  ///< the experiment's own first
  std::vector<PlannedRun> runs;                ///< by role (fit first), engine, scenario, index
  std::vector<RunGroup> groups;                ///< the experiment's own test runs first
  std::vector<Task> tasks;  ///< by test run, in the order of the plan, then noise seed

  TaskRange all_tasks() const { return {0, tasks.size()}; }
  const RunGroup& group_of(const Task& task) const { return groups[runs[task.run].group]; }
  /// The group of this name, if there is one.
  std::optional<std::size_t> group_called(std::string_view name) const;
  /// The test runs of a group, in the order of the plan.
  std::vector<std::size_t> runs_in(std::size_t group) const;
};

/// The group of the fitted runs of one entry of `fit.pieces`.
constexpr std::size_t segment_group(std::size_t entry) { return 1 + entry; }

/// Which of the experiment's test scenarios a test run plays.
std::size_t scene_of(const PlannedRun& run, const Experiment& experiment);

/// The seed that fitted runs are drawn with.
std::uint64_t seed_of_fit(const Experiment& experiment);

/// What the file's `fit`, `test`, `noise` and `highlights` ask for.
Plan plan_of(const RunRequest& request);

/// Adds the runs of one role in one setting, in every engine; of test runs, to a group.
void plan_runs(const RunRequest& request, RunRole role, const RobotAndSensors& setting, std::size_t group,
               Plan& plan);

/// Adds the runs whose pieces are fitted in one setting, where an estimator asks for pieces.
void plan_segments(const RunRequest& request, const RobotAndSensors& setting, Plan& plan);

/// Adds the fitted runs `first` to `end` of one entry of `fit.pieces`, in every engine.
void plan_segment_runs(const RunRequest& request, const RobotAndSensors& setting, std::size_t entry,
                     int first, int end, Plan& plan);

/// The runs that these tasks listen to, and those that their estimators are fitted to.
std::set<std::size_t> runs_for(const Plan& plan, const TaskRange& tasks);

/// Decides of which runs the recordings stay.
void keep_recordings(const Experiment& experiment, Plan& plan);

/// Adds the tasks of the runs from index `first` on.
void plan_tasks(const Experiment& experiment, std::size_t first, Plan& plan);

}  // namespace touchdown::experiments
