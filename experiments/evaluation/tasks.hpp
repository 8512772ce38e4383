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

/// What a task found out: by condition of the run's engine, then cell, then piece of the run. Empty
/// for a run that is not scored.
struct TaskCounts {
  std::vector<scoring::Classification> counted;
  std::vector<scoring::RobotScore> scored;         ///< of own-engine conditions
  std::vector<scoring::ExtendedScore> close;          ///< likewise; the whole run is one piece
  std::vector<scoring::Classification> disturbed;  ///< likewise
  /// What odometry makes of the oracles, then of conditions at home; the whole run.
  std::vector<scoring::TrajectoryScore> odometry;
  /// Of conditions at home: their own decisions in a cell, then those at the operating points; the
  /// whole run.
  std::vector<scoring::OperatingScore> operating;
};

/// As they lie in memory: for this build alone.
std::string to_bytes(const TaskCounts& counts);
/// Takes them off the front. Errors: `Error` when the bytes end before.
TaskCounts take_counts(std::string_view& bytes);

/// Adds what an estimator said about a run to what a task found out, in full.
void add_scores(const RunSignals& run, const scoring::Prediction& prediction,
                const scoring::ScoringConfig& scoring, bool has_extended_scores,
                TaskCounts& counts);

/// A task by a name that no other task of the plan has.
std::string task_name(const Plan& plan, const Task& task);

/// A file that is whole and in a task's place, but is not that task's of that request.
struct WrongPart {
  std::filesystem::path file;
  std::string found;     ///< what it says it is
  std::string expected;  ///< what it has to be
};

/// Where an experiment's tasks are saved.
class SavedCounts {
 public:
  /// `key` names the experiment and the build; with it a part carries its task's name. Nothing else
  /// is believed.
  SavedCounts(std::filesystem::path folder, std::string key);
  /// What is at hand instead of saved, by the tasks' names. Not to be written to.
  explicit SavedCounts(std::map<std::string, TaskCounts> at_hand) : at_hand_(std::move(at_hand)) {}

  std::optional<TaskCounts> read(const Plan& plan, const Task& task) const;
  void write(const Plan& plan, const Task& task, const TaskCounts& counts) const;
  /// What stands in a task's place and is not its own; nothing for what is right, missing or
  /// broken.
  std::optional<WrongPart> wrong_part(const Plan& plan, const Task& task) const;

 private:
  std::string key_of(const Plan& plan, const Task& task) const;

  std::filesystem::path folder_;
  std::string key_;
  std::optional<std::map<std::string, TaskCounts>> at_hand_;
};

/// Computes one task. Errors: `Stopped`.
TaskCounts evaluate(const Plan& plan, const Task& task, const RunSignals& run,
                  const scoring::ScoringConfig& scoring, const FittedModels& models,
                  const ShouldContinue& should_continue);

/// Computes and saves, in parallel, those tasks of the range that nobody has saved. Returns how
/// many these were. Errors: `Stopped`.
std::size_t evaluate(const Plan& plan, const TaskRange& tasks, const Rollouts& runs,
                   const scoring::ScoringConfig& scoring, const FittedModels& models,
                   const SavedCounts& saved, const ShouldContinue& should_continue);

/// What is known of one condition: `samples[c][i]` belongs to cell c and statistical sample i (a
/// run or a drop), all noise seeds added.
template <typename Sample>
struct ConditionSamples {
  Condition condition;
  std::vector<std::vector<Sample>> samples;
};

/// Those that were fitted where they are tested, with the experiment's own fit.
template <typename Sample>
std::vector<ConditionSamples<Sample>> own(std::vector<ConditionSamples<Sample>> all) {
  std::erase_if(all, [](const auto& one) { return !one.condition.is_fitted_in_domain(); });
  return all;
}

/// What one of them has in one cell.
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
  std::vector<ConditionSamples<scoring::ExtendedScore>> close;  ///< a sample is a run
  std::vector<ConditionCounts> disturbed;  ///< of own-engine conditions; a sample is a run
};

/// The findings of all tasks that listen to these runs of one group, added up in the order of the
/// tasks: whoever computed them, and in which order, the sums are the same. Errors: `Error` when
/// one is missing.
CollectedCounts collect(const Plan& plan, std::span<const std::size_t> runs,
                        const SavedCounts& saved);

/// What the tasks that listen to one run found out, noise seed by noise seed. Errors: `Error` when
/// one is missing.
std::vector<TaskCounts> findings_of(std::size_t run, const Plan& plan, const SavedCounts& saved);

/// An experiment that has been listened to, as its studies see it.
struct Evaluation {
  const RunRequest& request;
  const Plan& plan;
  const Rollouts& runs;
  const SavedCounts& saved;
  const CollectedCounts& own;  ///< of the experiment's own test runs
};

}  // namespace touchdown::experiments
