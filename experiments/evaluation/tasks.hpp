#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/plan.hpp"
#include "experiments/plan/rollouts.hpp"

namespace touchdown::experiments {

/// The saved results of a plan's model tasks, by name and item.
class SavedModelTasks {
 public:
  /// `folder` is the run directory's `state`; `key` identifies the experiment and the build. Files
  /// with another key are ignored.
  SavedModelTasks(std::filesystem::path folder, std::string key);

  std::optional<std::string> read(const ModelTasks& tasks, std::size_t item) const;
  void write(const ModelTasks& tasks, std::size_t item, const std::string& bytes) const;
  /// The file of an item.
  std::filesystem::path file(const ModelTasks& tasks, std::size_t item) const;

 private:
  std::filesystem::path folder_;
  std::string key_;
};

/// The share of some model tasks that belongs to a share of the plan's tasks.
TaskRange share_of(const ModelTasks& model_tasks, const TaskRange& tasks, std::size_t all_tasks);

/// Whether that share holds any work.
bool has_model_tasks(const Plan& plan, const TaskRange& tasks);

/// Computes and saves, in parallel, the items of this share that are not saved yet. Errors: `Error`
/// for an item that is missing and must not be computed; `Stopped`; those of the tasks.
void run_model_tasks(const Plan& plan, const TaskRange& tasks, const FittedModels& models,
                     const SavedModelTasks& saved, MissingRun missing,
                     const ShouldContinue& should_continue);

/// Whether an item of this share is not saved.
bool lacks_model_tasks(const Plan& plan, const TaskRange& tasks, const SavedModelTasks& saved);

/// What a measure found in one run, or in one prediction.
struct MeasuredBytes {
  std::string measure;          ///< its name
  std::uint32_t condition = 0;  ///< index in the group's conditions of the run's engine
  std::uint32_t cell = 0;       ///< index in the group's scored cells
  std::string bytes;            ///< the scores
};
/// The condition of a measure of the run itself.
inline constexpr std::uint32_t no_condition = 0xffffffffU;

/// The results of a task. Counts and scores are by condition of the run's engine, then cell, then
/// segment of the run. Empty for a run that is not scored.
struct TaskCounts {
  std::vector<scoring::Classification> counted;
  std::vector<scoring::RobotScore> scored;  ///< of predictions
  std::vector<MeasuredBytes> measured;      ///< by the group's measures

  bool is_scored() const { return !counted.empty() || !scored.empty(); }
};

/// Serialises counts in their memory layout, which only the same build can read.
std::string to_bytes(const TaskCounts& counts);
/// Reads counts and removes them from the front. Errors: `Error` for too few bytes.
TaskCounts take_counts(std::string_view& bytes);

/// Scores a prediction of a run, measures included, and adds the results to a task's. `condition`
/// is the index of the prediction's condition.
void add_scores(const MeasuredPrediction& prediction, std::span<const Measure> measures,
                std::uint32_t condition, TaskCounts& counts);

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

/// Scores without sensor noise, which are equal for all noise seeds of a run. Several threads may
/// use it at once.
class NoiseFreeScores {
 public:
  struct Key {
    std::size_t run;        ///< index in the plan
    std::size_t condition;  ///< index among those of the run's engine
    std::size_t cell;       ///< index among the group's scored cells

    friend bool operator<(const Key& a, const Key& b) {
      return std::tie(a.run, a.condition, a.cell) < std::tie(b.run, b.condition, b.cell);
    }
  };
  using Scores = std::vector<scoring::RobotScore>;

  /// The known scores; computes them if there are none.
  Scores scores(const Key& key, const std::function<Scores()>& compute);

 private:
  std::mutex mutex_;
  std::map<Key, Scores> known_;
};

/// Computes one task. Errors: `Stopped`.
TaskCounts evaluate(const Plan& plan, const Task& task, const RunSignals& run,
                    const Experiment& experiment, const FittedModels& models,
                    NoiseFreeScores& noise_free, const ShouldContinue& should_continue);

/// Computes and saves one task of this run, unless it is saved. Returns whether it was computed.
/// Errors: `Stopped`.
bool evaluate_and_save(const Plan& plan, const Task& task, const Rollout& run,
                       const Experiment& experiment, const FittedModels& models,
                       const SavedCounts& saved, NoiseFreeScores& noise_free,
                       const ShouldContinue& should_continue);

/// Computes and saves, in parallel, those of the tasks, given as indices in the plan, that belong
/// to these runs and are not saved yet. Returns their number. Errors: `Stopped`.
std::size_t evaluate(const Plan& plan, std::span<const std::size_t> tasks, const Rollouts& runs,
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
};

/// Adds the results of all tasks of these runs of one group, in the order of the tasks. The sums
/// thereby do not depend on which process computed the tasks, and when. Errors: `Error` when one is
/// missing.
CollectedCounts collect(const Plan& plan, std::span<const std::size_t> runs,
                        const SavedCounts& saved);

/// The results of all tasks of these runs in memory, for several readers: each file is read once.
/// Errors: `Error` when one is missing.
SavedCounts in_memory(const Plan& plan, std::span<const std::size_t> runs,
                      const SavedCounts& saved);

/// The results of all tasks of one run, by noise seed. Errors: `Error` when one is missing.
std::vector<TaskCounts> task_counts_of(std::size_t run, const Plan& plan, const SavedCounts& saved);

/// The scores of one measure in one run, all noise seeds added.
template <typename Score>
struct MeasuredScores {
  std::uint32_t condition = 0;  ///< as in `MeasuredBytes`
  std::uint32_t cell = 0;
  std::vector<Score> scores;
};

/// The scores of a measure in one run of the plan, in the order of their measurement; empty for a
/// run that is not scored. Errors: `Error` when a task is missing.
template <typename Score>
std::vector<MeasuredScores<Score>> measured(std::string_view measure, std::size_t run,
                                            const Plan& plan, const SavedCounts& saved) {
  std::vector<MeasuredScores<Score>> sums;
  for (const TaskCounts& task : task_counts_of(run, plan, saved)) {
    for (const MeasuredBytes& found : task.measured) {
      if (found.measure != measure) continue;
      const std::vector<Score> scores = from_bytes<Score>(found.bytes);
      const auto same = std::find_if(sums.begin(), sums.end(), [&](const auto& one) {
        return one.condition == found.condition && one.cell == found.cell;
      });
      if (same == sums.end()) {
        sums.push_back({found.condition, found.cell, scores});
      } else {
        for (std::size_t i = 0; i < scores.size(); ++i) same->scores[i] += scores[i];
      }
    }
  }
  return sums;
}

/// The first score of a measure of predictions, by condition and cell; a sample is a run. `runs`
/// are of one group. Conditions without scores have no samples.
template <typename Score>
std::vector<ConditionSamples<Score>> measured_samples(std::string_view measure,
                                                      std::span<const std::size_t> runs,
                                                      const Plan& plan, const SavedCounts& saved) {
  std::vector<ConditionSamples<Score>> all;
  if (runs.empty()) return all;
  const RunGroup& group = plan.groups[plan.runs[runs.front()].group];
  for (const Condition& condition : group.conditions) {
    all.push_back({condition, std::vector<std::vector<Score>>(group.scored.size())});
  }
  for (const std::size_t run : runs) {
    std::vector<ConditionSamples<Score>*> tested;
    for (ConditionSamples<Score>& one : all) {
      if (one.condition.test_simulator == plan.runs[run].simulator) tested.push_back(&one);
    }
    for (const MeasuredScores<Score>& found : measured<Score>(measure, run, plan, saved)) {
      tested[found.condition]->samples[found.cell].push_back(found.scores.front());
    }
  }
  return all;
}

/// The evaluated experiment, as its studies use it.
struct Evaluation {
  const RunRequest& request;
  const Plan& plan;
  const Rollouts& runs;
  const SavedCounts& saved;
  const CollectedCounts& own;  ///< of the experiment's own test runs
  const FittedModels& models;
  const SavedModelTasks& model_results;
};

}  // namespace touchdown::experiments
