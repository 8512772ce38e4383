#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/fitting/fitting.hpp"
#include "experiments/rollouts/rollouts.hpp"
#include "scoring/extended_score.hpp"
#include "scoring/operating_point.hpp"
#include "scoring/trajectory.hpp"

namespace touchdown::experiments {

/// The results of a task: by condition of the run's engine, then cell, then segment of the run.
/// Empty for a run that is not scored.
struct TaskCounts {
  std::vector<scoring::Classification> counted;
  std::vector<scoring::RobotScore> scored;         ///< of the conditions that the group scores
  std::vector<scoring::ExtendedScore> extended;    ///< of the same; the whole run is one segment
  std::vector<scoring::Classification> disturbed;  ///< of the same; the whole run is one segment
  /// Odometry with contact from the oracles, then from in-domain conditions; over the whole run.
  std::vector<scoring::TrajectoryScore> odometry;
  /// Of in-domain conditions: their own decisions in a cell, then those at the operating points;
  /// over the whole run.
  std::vector<scoring::OperatingScore> operating;
};

/// Serialises counts in their memory layout, which only the same build can read.
std::string to_bytes(const TaskCounts& counts);
/// Reads counts and removes them from the front. Errors: `Error` for too few bytes.
TaskCounts take_counts(std::string_view& bytes);

/// Scores an estimator's prediction of a run and adds the scores to a task's results.
void add_scores(const RunSignals& run, const scoring::Prediction& prediction,
                const scoring::ScoringConfig& scoring, bool has_extended_scores,
                TaskCounts& counts);

/// A name of the task that is unique in the plan.
std::string task_name(const Plan& plan, const Task& task);

/// A complete file at a task's path that belongs to another task or request.
struct WrongPart {
  std::filesystem::path file;
  std::string found;     ///< the key in the file
  std::string expected;  ///< the key of the task
};

/// The saved results of an experiment's tasks.
class SavedCounts {
 public:
  /// `key` identifies the experiment and the build. Each file stores it with the task's name; files
  /// with another key are ignored.
  SavedCounts(std::filesystem::path folder, std::string key);
  /// Results in memory instead of files, by the tasks' names. `write` must not be called.
  explicit SavedCounts(std::map<std::string, TaskCounts> in_memory)
      : in_memory_(std::move(in_memory)) {}

  std::optional<TaskCounts> read(const Plan& plan, const Task& task) const;
  void write(const Plan& plan, const Task& task, const TaskCounts& counts) const;
  /// The file at a task's path, if it belongs to another task. Nothing for a correct, missing or
  /// broken file.
  std::optional<WrongPart> wrong_part(const Plan& plan, const Task& task) const;

 private:
  std::string key_of(const Plan& plan, const Task& task) const;

  std::filesystem::path folder_;
  std::string key_;
  std::optional<std::map<std::string, TaskCounts>> in_memory_;
};

/// Computes one task. Errors: `Stopped`.
TaskCounts evaluate(const Plan& plan, const Task& task, const RunSignals& run,
                    const Experiment& experiment, const FittedModels& models,
                    const ShouldContinue& should_continue);

/// Computes and saves, in parallel, those tasks of the range that are not saved yet. Returns their
/// number. Errors: `Stopped`.
std::size_t evaluate(const Plan& plan, const TaskRange& tasks, const Rollouts& runs,
                     const Experiment& experiment, const FittedModels& models,
                     const SavedCounts& saved, const ShouldContinue& should_continue);

/// All results of one condition: `samples[c][i]` belongs to cell c and statistical sample i (a run
/// or a drop), all noise seeds added.
template <typename Sample>
struct ConditionSamples {
  Condition condition;
  std::vector<std::vector<Sample>> samples;
};

/// The conditions that were fitted on the engine of their test, with the experiment's own fit.
template <typename Sample>
std::vector<ConditionSamples<Sample>> own(std::vector<ConditionSamples<Sample>> all) {
  std::erase_if(all, [](const auto& one) { return !one.condition.is_fitted_in_domain(); });
  return all;
}

/// The samples of one condition in one cell.
template <typename Sample>
const std::vector<Sample>& samples_of(const std::vector<ConditionSamples<Sample>>& all,
                                      const Condition& condition, std::size_t cell) {
  return std::find_if(
             all.begin(), all.end(),
             [&](const ConditionSamples<Sample>& one) { return one.condition == condition; })
      ->samples[cell];
}

using ConditionCounts = ConditionSamples<scoring::Classification>;  ///< both wheels added
using ConditionScores = ConditionSamples<scoring::RobotScore>;

struct CollectedCounts {
  std::vector<ConditionCounts> counted;
  std::vector<ConditionScores> scored;
  std::vector<ConditionSamples<scoring::ExtendedScore>> extended;  ///< a sample is a run
  std::vector<ConditionCounts>
      disturbed;  ///< of conditions fitted on this engine; a sample is a run
};

/// Adds the results of all tasks of these runs of one group, in the order of the tasks. The sums
/// thereby do not depend on which process computed the tasks, and when. Errors: `Error` when one is
/// missing.
CollectedCounts collect(const Plan& plan, std::span<const std::size_t> runs,
                        const SavedCounts& saved);

/// The results of all tasks of one run, by noise seed. Errors: `Error` when one is missing.
std::vector<TaskCounts> task_counts_of(std::size_t run, const Plan& plan, const SavedCounts& saved);

/// The evaluated experiment, as its studies use it.
struct Evaluation {
  const RunRequest& request;
  const Plan& plan;
  const Rollouts& runs;
  const SavedCounts& saved;
  const CollectedCounts& own;  ///< of the experiment's own test runs
};

}  // namespace touchdown::experiments
