#include "experiments/evaluation/tasks.hpp"

#include <atomic>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/progress.hpp"

namespace touchdown::experiments {

namespace {

std::string name_of(const ModelTasks& tasks, std::size_t item) {
  return fmt::format("{}_{:06}", tasks.unit, item);
}

std::string title_of(const ModelTasks& tasks) {
  std::string title = tasks.name;
  std::replace(title.begin(), title.end(), '_', ' ');
  return title;
}

std::vector<scoring::RobotScore> scores_of(const scoring::Prediction& prediction,
                                           const RunSignals& run,
                                           const scoring::ScoringConfig& scoring) {
  return scoring::score(run.contact, prediction, run.segments, run.info.control_period_us, scoring);
}

}  // namespace

std::optional<std::string> saved_result(const ModelTasks& tasks, std::size_t item,
                                        const Store& store) {
  return store.find<std::string>(tasks.name, name_of(tasks, item));
}

TaskRange share_of(const ModelTasks& model_tasks, const TaskRange& tasks, std::size_t all_tasks) {
  return {model_tasks.count * tasks.begin / all_tasks, model_tasks.count * tasks.end / all_tasks};
}

bool has_model_tasks(const Plan& plan, const TaskRange& tasks) {
  return std::any_of(plan.model_tasks.begin(), plan.model_tasks.end(), [&](const ModelTasks& one) {
    return share_of(one, tasks, plan.tasks.size()).size() > 0;
  });
}

void run_model_tasks(const Plan& plan, const TaskRange& tasks, const FittedModels& models,
                     const Store& store, const ShouldContinue& should_continue) {
  for (const ModelTasks& one : plan.model_tasks) {
    const TaskRange items = share_of(one, tasks, plan.tasks.size());
    Progress progress(title_of(one), one.unit + "s", static_cast<std::int64_t>(items.size()));
    tbb::parallel_for(items.begin, items.end, [&](std::size_t item) {
      if (!should_continue()) throw Stopped();
      const std::string name = name_of(one, item);
      (void)store.get<std::string>(one.name, name,
                                   [&] { return one.compute(item, models, should_continue); });
      progress.advance();
    });
  }
}

void add_scores(const MeasuredPrediction& prediction, std::span<const Measure> measures,
                std::uint32_t condition, TaskCounts& counts) {
  const std::vector<scoring::RobotScore> scores =
      scores_of(prediction.prediction, prediction.run.signals, prediction.run.scoring);
  counts.scored.insert(counts.scored.end(), scores.begin(), scores.end());
  for (const Measure& measure : measures) {
    if (!measure.of_prediction) continue;
    std::string bytes = measure.of_prediction(prediction);
    if (bytes.empty()) continue;
    counts.measured.push_back(
        {measure.name, condition, static_cast<std::uint32_t>(prediction.cell), std::move(bytes)});
  }
}

std::string task_name(const Plan& plan, const Task& task) {
  const PlannedRun& run = plan.runs[task.run];
  // Groups may have the same runs, but their names differ.
  std::string group = plan.group_of(task).name;
  std::replace(group.begin(), group.end(), ' ', '_');
  return fmt::format("{}{}{}_seed_{:04}", std::filesystem::path(run.file).stem().string(),
                     group.empty() ? "" : "_", group, task.seed);
}

std::optional<TaskCounts> saved_counts(const Plan& plan, const Task& task, const Store& store) {
  return store.find<TaskCounts>(task_parts, task_name(plan, task));
}

TaskCounts counts_of(const Plan& plan, const Task& task, const Store& store) {
  std::optional<TaskCounts> found = saved_counts(plan, task, store);
  if (!found) throw Error(fmt::format("the results of {} are missing", task_name(plan, task)));
  return *std::move(found);
}

NoiseFreeScores::Scores NoiseFreeScores::scores(const Key& key,
                                                const std::function<Scores()>& compute) {
  {
    const std::scoped_lock lock(mutex_);
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
  }
  // Two threads may compute the same scores at once, rather than one wait for the other.
  Scores computed = compute();
  const std::scoped_lock lock(mutex_);
  return known_.emplace(key, std::move(computed)).first->second;
}

TaskCounts evaluate(const Plan& plan, const Task& task, const RunSignals& run,
                    const Experiment& experiment, const FittedModels& models,
                    NoiseFreeScores& noise_free, const ShouldContinue& should_continue) {
  const scoring::ScoringConfig& scoring = experiment.scoring;
  const RunGroup& group = plan.group_of(task);
  const std::vector<Condition> conditions = tested_on(group.conditions, run.info.simulator);
  const NoiseRun noise = noise_run(run, task.noise);
  TaskCounts counts;
  std::vector<Condition> counted = conditions;
  std::erase_if(counted, [&](const Condition& one) { return !group.counts(one); });
  counts.counted =
      sweep_run(counted, group.counted, run, noise, models, experiment, should_continue);
  const MeasuredRun measured{run, noise, task.seed, group.scored, scoring};
  for (const Measure& measure : group.measures) {
    if (!measure.of_run) continue;
    if (!should_continue()) throw Stopped();
    std::string bytes = measure.of_run(measured);
    if (!bytes.empty())
      counts.measured.push_back({measure.name, no_condition, 0, std::move(bytes)});
  }
  const bool measures_predictions = std::ranges::any_of(
      group.measures, [](const Measure& measure) { return bool{measure.of_prediction}; });
  for (std::uint32_t c = 0; c < conditions.size(); ++c) {
    if (!group.predicts(conditions[c])) continue;
    EstimatorRunner runner = runner_of(experiment, conditions[c], models, run);
    for (std::size_t cell = 0; cell < group.scored.size(); ++cell) {
      if (!should_continue()) throw Stopped();
      const noise::SensorNoise levels = group.scored[cell].levels();
      if (levels == noise::SensorNoise{} && !measures_predictions) {
        const auto scores = noise_free.scores({task.run, c, cell}, [&] {
          return scores_of(predict(runner, run, noise, levels), run, scoring);
        });
        counts.scored.insert(counts.scored.end(), scores.begin(), scores.end());
        continue;
      }
      const scoring::Prediction prediction = predict(runner, run, noise, levels);
      add_scores({measured, conditions[c], cell, prediction}, group.measures, c, counts);
    }
  }
  return counts;
}

bool evaluate_and_save(const Plan& plan, const Task& task, const Rollout& run,
                       const Experiment& experiment, const FittedModels& models, const Store& store,
                       NoiseFreeScores& noise_free, const ShouldContinue& should_continue) {
  bool is_computed = false;
  (void)store.get<TaskCounts>(task_parts, task_name(plan, task), [&] {
    is_computed = true;
    TaskCounts counts = run.failed() ? TaskCounts()
                                     : evaluate(plan, task, run.signals, experiment, models,
                                                noise_free, should_continue);
    counts.report = run.report;
    return counts;
  });
  return is_computed;
}

}  // namespace touchdown::experiments
