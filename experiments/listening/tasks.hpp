#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/fitting/fitting.hpp"
#include "experiments/play/play.hpp"
#include "scoring/close_score.hpp"

namespace touchdown::experiments {

/// What a task found out; empty for a run that is not scored.
struct TaskCounts {
  std::vector<scoring::Classification>
      counted;  ///< by condition of the run's engine, cell, piece of the run
  std::vector<scoring::RobotScore> scored;         ///< by cell, own-engine condition, piece
  std::vector<scoring::CloseScore> close;          ///< by cell, own-engine condition
  std::vector<scoring::Classification> disturbed;  ///< by cell, own-engine condition
};

/// Where an experiment's tasks are saved.
class SavedCounts {
 public:
  /// `key` names the experiment and the build: nothing else is believed.
  SavedCounts(std::filesystem::path folder, std::string key);

  std::optional<TaskCounts> read(const Plan& plan, const Task& task) const;
  void write(const Plan& plan, const Task& task, const TaskCounts& counts) const;

 private:
  std::filesystem::path folder_;
  std::string key_;
};

/// Computes one task. Errors: `Stopped`.
TaskCounts listen(const Plan& plan, const Task& task, const RunSignals& run,
                  const scoring::ScoringConfig& scoring, const FittedModels& models,
                  const GoingOn& going_on);

/// Computes and saves, in parallel, those tasks of the range that nobody has saved. Returns how
/// many these were. Errors: `Stopped`.
std::size_t listen(const Plan& plan, const TaskRange& tasks, const PlayedRuns& runs,
                   const scoring::ScoringConfig& scoring, const FittedModels& models,
                   const SavedCounts& saved, const GoingOn& going_on);

/// Point-wise counts of one condition: `samples[c][i]` belongs to cell c and statistical sample i
/// (a run or a drop), both wheels and all noise seeds added.
struct ConditionCounts {
  Condition condition;
  std::vector<std::vector<scoring::Classification>> samples;
};

/// Full scores of one condition at one noise setting; one entry per statistical sample.
struct ConditionScores {
  Condition condition;
  std::vector<scoring::RobotScore> samples;
};

struct ConditionCloseScores {
  Condition condition;
  std::vector<scoring::CloseScore> samples;
};

struct CollectedCounts {
  std::vector<ConditionCounts> counted;
  std::vector<std::vector<ConditionScores>> scored;      ///< by cell
  std::vector<std::vector<ConditionCloseScores>> close;  ///< likewise; a sample is a run
  std::vector<ConditionCounts> disturbed;  ///< of own-engine conditions; a sample is a run

  /// Without the conditions that were fitted elsewhere than where they are tested.
  std::vector<ConditionCounts> own() const;
};

/// The findings of all tasks that listen to these runs of one group, added up in the order of the
/// tasks: whoever computed them, and in which order, the sums are the same. Errors: `Error` when
/// one is missing.
CollectedCounts collect(const Plan& plan, std::span<const std::size_t> runs,
                        const SavedCounts& saved);

}  // namespace touchdown::experiments
