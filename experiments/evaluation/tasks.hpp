#pragma once

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

/// Computes and saves, in parallel, the items of this share that are not saved yet. Errors:
/// `Stopped`; those of the tasks.
void run_model_tasks(const Plan& plan, const TaskRange& tasks, const FittedModels& models,
                     const Store& store, const ShouldContinue& should_continue);

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
/// Errors: `Error` when they are missing.
TaskCounts counts_of(const Plan& plan, const Task& task, const Store& store);

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

}  // namespace touchdown::experiments
