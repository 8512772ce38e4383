#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
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
#include "experiments/run_directory/store.hpp"

namespace touchdown::experiments {

/// The saved result of an item of model tasks; nothing if it is not computed yet.
std::optional<std::string> saved_result(const ModelTasks& tasks, std::size_t item,
                                        const Store& store);

/// The share of some model tasks that belongs to a share of the plan's tasks.
TaskRange share_of(const ModelTasks& model_tasks, const TaskRange& tasks, std::size_t all_tasks);

/// Whether that share holds any work.
bool has_model_tasks(const Plan& plan, const TaskRange& tasks);

/// Computes and saves, in parallel, the items of this share that are not saved yet. Errors: `Error`
/// for an item that is missing and must not be computed; `Stopped`; those of the tasks.
void run_model_tasks(const Plan& plan, const TaskRange& tasks, const FittedModels& models,
                     const Store& store, MissingRun missing, const ShouldContinue& should_continue);

/// Whether an item of this share is not saved.
bool lacks_model_tasks(const Plan& plan, const TaskRange& tasks, const Store& store);

/// What a measure found in one run, or in one prediction.
struct MeasuredBytes {
  std::string measure;          ///< its name
  std::uint32_t condition = 0;  ///< index in the group's conditions of the run's engine
  std::uint32_t cell = 0;       ///< index in the group's scored cells
  std::string bytes;            ///< the scores

  static auto members(auto& found) {
    return std::tie(found.measure, found.condition, found.cell, found.bytes);
  }
};
/// The condition of a measure of the run itself.
inline constexpr std::uint32_t no_condition = 0xffffffffU;

/// The results of a task. Counts and scores are by condition of the run's engine, then cell, then
/// segment of the run. Empty for a run that is not scored.
struct TaskCounts {
  RunReport report = {};  ///< of the run
  std::vector<scoring::Classification> counted = {};
  std::vector<scoring::RobotScore> scored = {};  ///< of predictions
  std::vector<MeasuredBytes> measured = {};      ///< by the group's measures

  bool is_scored() const { return !counted.empty() || !scored.empty(); }

  static auto members(auto& counts) {
    return std::tie(counts.report, counts.counted, counts.scored, counts.measured);
  }
};

/// Scores a prediction of a run, measures included, and adds the results to a task's. `condition`
/// is the index of the prediction's condition.
void add_scores(const MeasuredPrediction& prediction, std::span<const Measure> measures,
                std::uint32_t condition, TaskCounts& counts);

/// The results of tasks in the store are of this kind, and have the task's name: unique in the
/// plan.
inline constexpr std::string_view task_parts = "evaluation";
std::string task_name(const Plan& plan, const Task& task);

/// The saved results of a task; nothing if it is not computed yet.
std::optional<TaskCounts> saved_counts(const Plan& plan, const Task& task, const Store& store);

/// Whether an estimator's signal guard would pass every step of a run at all of these levels. Only
/// then can a batch, which has no guard, replace the estimator.
bool needs_no_guard(const RunSignals& run, std::span<const noise::SensorNoise> levels);

/// Point-wise counts of one run with one noise realisation, both wheels added: by condition, then
/// cell, then segment of the run (`RunSignals::segments`). Estimators with a batched form process
/// all noise levels at once. Noise on a sensor that an estimator does not use costs no time.
/// Errors: `Stopped`.
std::vector<scoring::Classification> sweep_run(std::span<const Condition> conditions,
                                               std::span<const noise::NoiseCell> cells,
                                               const RunSignals& run, const NoiseRun& noise,
                                               const FittedModels& models,
                                               const Experiment& experiment,
                                               const ShouldContinue& should_continue);

/// The counts of one estimator that processes the noise levels one by one: by level, then segment.
std::vector<scoring::Classification> sweep_levels(const EstimatorRunner& runner,
                                                  std::span<const noise::SensorNoise> levels,
                                                  const RunSignals& run, const NoiseRun& noise,
                                                  const scoring::ScoringConfig& scoring,
                                                  const ShouldContinue& should_continue);

/// Scores without sensor noise, which are equal for all noise seeds of a run. Several threads may
/// use it at once.
class NoiseFreeScores {
 public:
  struct Key {
    std::size_t run;        ///< index in the plan
    std::size_t condition;  ///< index among those of the run's engine
    std::size_t cell;       ///< index among the group's scored cells

    auto operator<=>(const Key&) const = default;
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
                       const Experiment& experiment, const FittedModels& models, const Store& store,
                       NoiseFreeScores& noise_free, const ShouldContinue& should_continue);

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
  return std::ranges::find(all, condition, &ConditionSamples<Sample>::condition)->samples[cell];
}

using ConditionCounts = ConditionSamples<scoring::Classification>;  ///< both wheels added
using ConditionScores = ConditionSamples<scoring::RobotScore>;

/// The origin of a statistical sample.
struct SampleOrigin {
  std::size_t run = 0;      ///< index in the plan
  std::size_t segment = 0;  ///< of the run: a drop
};

struct CollectedCounts {
  std::vector<ConditionCounts> counted;
  std::vector<ConditionScores> scored;
  /// Of the samples, by engine.
  std::map<std::string, std::vector<SampleOrigin>> origins = {};
};

/// Adds the results of all tasks of these runs of one group, in the order of the tasks. The sums
/// thereby do not depend on which process computed the tasks, and when. Errors: `Error` when one is
/// missing.
CollectedCounts collect(const Plan& plan, std::span<const std::size_t> runs, const Store& store);

/// The results of all tasks of these runs in memory, for several readers: each file is read once.
/// Errors: `Error` when one is missing.
Store in_memory(const Plan& plan, std::span<const std::size_t> runs, const Store& store);

/// The results of all tasks of one run, by noise seed. Errors: `Error` when one is missing.
std::vector<TaskCounts> task_counts_of(std::size_t run, const Plan& plan, const Store& store);

/// What a measure wrote about a run itself, noise seed by noise seed; empty for a run that is not
/// scored. Errors: `Error` when a task is missing.
std::string measured_of_run(std::string_view measure, std::size_t run, const Plan& plan,
                            const Store& store);

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
                                            const Plan& plan, const Store& store) {
  std::vector<MeasuredScores<Score>> sums;
  for (const TaskCounts& task : task_counts_of(run, plan, store)) {
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
                                                      const Plan& plan, const Store& store) {
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
    for (const MeasuredScores<Score>& found : measured<Score>(measure, run, plan, store)) {
      tested[found.condition]->samples[found.cell].push_back(found.scores.front());
    }
  }
  return all;
}

/// The evaluated experiment, as its studies use it.
struct Evaluation {
  const RunRequest& request;
  const Plan& plan;
  const FinishedRuns& runs;    ///< the test runs, and those of their fits
  const Store& saved;          ///< the results of tasks and model tasks
  const CollectedCounts& own;  ///< of the experiment's own test runs
  const FittedModels& models;
};

}  // namespace touchdown::experiments
