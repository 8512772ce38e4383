#include "experiments/evaluation/tasks.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <type_traits>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "experiments/evaluation/sweep_run.hpp"
#include "experiments/run_directory/saved_state.hpp"

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

// The build is part of a state file's key, so numbers can be saved in their memory layout.
template <typename T>
void append(std::string& bytes, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::uint64_t count = values.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof(T));
}

template <typename T>
void take(std::vector<T>& values, std::string_view& bytes) {
  std::uint64_t count = 0;
  if (bytes.size() < sizeof count) throw Error("a state file is too short");
  std::memcpy(&count, bytes.data(), sizeof count);
  bytes.remove_prefix(sizeof count);
  if (bytes.size() / sizeof(T) < count) throw Error("a state file is too short");
  values.resize(count);
  if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
  bytes.remove_prefix(count * sizeof(T));
}

void append(std::string& bytes, std::string_view text) {
  const std::uint64_t count = text.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(text);
}

std::string take_text(std::string_view& bytes) {
  std::vector<char> text;
  take(text, bytes);
  return {text.begin(), text.end()};
}

/// Adds the results of one task to the conditions that are tested on its engine. All noise seeds of
/// a run are one sample, so later seeds are added to the sample of the first one.
template <typename Sample>
void add_samples(std::vector<ConditionSamples<Sample>>& all, const std::vector<Sample>& found,
                 const std::string& simulator, bool first_seed) {
  std::vector<std::vector<Sample>*> cells;
  for (ConditionSamples<Sample>& condition : all) {
    if (condition.condition.test_simulator != simulator) continue;
    for (std::vector<Sample>& samples : condition.samples) cells.push_back(&samples);
  }
  auto next = found.begin();
  for (std::vector<Sample>* samples : cells) {
    const std::size_t segments = found.size() / cells.size();
    if (first_seed) samples->resize(samples->size() + segments);
    for (std::size_t i = samples->size() - segments; i < samples->size(); ++i) {
      (*samples)[i] += *next++;
    }
  }
}

std::vector<scoring::RobotScore> scores_of(const scoring::Prediction& prediction,
                                           const RunSignals& run,
                                           const scoring::ScoringConfig& scoring) {
  return scoring::score(run.contact, prediction, run.segments, run.info.control_period_us, scoring);
}

}  // namespace

SavedModelTasks::SavedModelTasks(std::filesystem::path folder, std::string key)
    : folder_(std::move(folder)), key_(std::move(key)) {}

std::filesystem::path SavedModelTasks::file(const ModelTasks& tasks, std::size_t item) const {
  return folder_ / tasks.name / name_of(tasks, item);
}

std::optional<std::string> SavedModelTasks::read(const ModelTasks& tasks, std::size_t item) const {
  return read_state(file(tasks, item),
                    fmt::format("{} {} {}", key_, tasks.name, name_of(tasks, item)));
}

void SavedModelTasks::write(const ModelTasks& tasks, std::size_t item,
                            const std::string& bytes) const {
  write_state(file(tasks, item), fmt::format("{} {} {}", key_, tasks.name, name_of(tasks, item)),
              bytes);
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
                     const SavedModelTasks& saved, MissingRun missing,
                     const ShouldContinue& should_continue) {
  for (const ModelTasks& one : plan.model_tasks) {
    const TaskRange items = share_of(one, tasks, plan.tasks.size());
    Progress progress(title_of(one), one.unit + "s", static_cast<std::int64_t>(items.size()));
    tbb::parallel_for(items.begin, items.end, [&](std::size_t item) {
      if (!should_continue()) throw Stopped();
      if (!saved.read(one, item)) {
        if (missing == MissingRun::refuse) {
          throw Error(fmt::format("state/{}/{} is missing", one.name, name_of(one, item)));
        }
        saved.write(one, item, one.compute(item, models, should_continue));
      }
      progress.advance();
    });
  }
}

bool lacks_model_tasks(const Plan& plan, const TaskRange& tasks, const SavedModelTasks& saved) {
  for (const ModelTasks& one : plan.model_tasks) {
    const TaskRange items = share_of(one, tasks, plan.tasks.size());
    for (std::size_t item = items.begin; item < items.end; ++item) {
      if (!saved.read(one, item)) return true;
    }
  }
  return false;
}

std::string to_bytes(const TaskCounts& counts) {
  std::string bytes;
  append(bytes, counts.counted);
  append(bytes, counts.scored);
  for (const MeasuredBytes& found : counts.measured) {
    append(bytes, std::vector{found.condition, found.cell});
    append(bytes, found.measure);
    append(bytes, found.bytes);
  }
  append(bytes, std::vector<std::uint32_t>());  // ends the measures
  return bytes;
}

TaskCounts take_counts(std::string_view& bytes) {
  TaskCounts counts;
  take(counts.counted, bytes);
  take(counts.scored, bytes);
  std::vector<std::uint32_t> place;
  for (take(place, bytes); place.size() == 2; take(place, bytes)) {
    MeasuredBytes found;
    found.condition = place[0];
    found.cell = place[1];
    found.measure = take_text(bytes);
    found.bytes = take_text(bytes);
    counts.measured.push_back(std::move(found));
  }
  return counts;
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

SavedCounts::SavedCounts(std::filesystem::path folder, std::string key)
    : folder_(std::move(folder)), key_(std::move(key)) {}

std::optional<TaskCounts> SavedCounts::read(const Plan& plan, const Task& task) const {
  if (in_memory_) {
    const auto found = in_memory_->find(task_name(plan, task));
    return found == in_memory_->end() ? std::nullopt : std::optional(found->second);
  }
  const std::optional<std::string> bytes =
      read_state(folder_ / task_name(plan, task), key_of(plan, task));
  if (!bytes) return std::nullopt;
  std::string_view rest = *bytes;
  return take_counts(rest);
}

void SavedCounts::write(const Plan& plan, const Task& task, const TaskCounts& counts) const {
  write_state(folder_ / task_name(plan, task), key_of(plan, task), to_bytes(counts));
}

std::optional<WrongPart> SavedCounts::wrong_part(const Plan& plan, const Task& task) const {
  const std::filesystem::path file = folder_ / task_name(plan, task);
  const std::optional<SavedState> state = read_any_state(file);
  const std::string expected = key_of(plan, task);
  if (!state || state->key == expected) return std::nullopt;
  return WrongPart{file, state->key, expected};
}

std::string SavedCounts::key_of(const Plan& plan, const Task& task) const {
  return fmt::format("{} part {}", key_, task_name(plan, task));
}

static TaskCounts saved_counts(const Plan& plan, const Task& task, const SavedCounts& saved) {
  std::optional<TaskCounts> found = saved.read(plan, task);
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
  const bool measures_predictions =
      std::any_of(group.measures.begin(), group.measures.end(),
                  [](const Measure& measure) { return bool{measure.of_prediction}; });
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
                       const Experiment& experiment, const FittedModels& models,
                       const SavedCounts& saved, NoiseFreeScores& noise_free,
                       const ShouldContinue& should_continue) {
  if (saved.read(plan, task)) return false;
  saved.write(plan, task,
              run.failed() ? TaskCounts{}
                           : evaluate(plan, task, run.signals, experiment, models, noise_free,
                                      should_continue));
  return true;
}

std::size_t evaluate(const Plan& plan, std::span<const std::size_t> tasks, const Rollouts& runs,
                     const Experiment& experiment, const FittedModels& models,
                     const SavedCounts& saved, const ShouldContinue& should_continue) {
  std::vector<std::size_t> held;
  for (const std::size_t t : tasks) {
    if (runs.contains(plan.tasks[t].run)) held.push_back(t);
  }
  if (held.empty()) return 0;
  Progress progress("evaluating", "parts", static_cast<std::int64_t>(held.size()));
  std::atomic<std::size_t> computed = 0;
  NoiseFreeScores noise_free;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, held.size(), 1), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      if (!should_continue()) throw Stopped();
      const Task& task = plan.tasks[held[i]];
      if (evaluate_and_save(plan, task, runs.at(task.run), experiment, models, saved, noise_free,
                            should_continue)) {
        ++computed;
        progress.advance();
      } else {
        progress.skip();
      }
    }
  });
  return computed;
}

SavedCounts in_memory(const Plan& plan, std::span<const std::size_t> runs,
                      const SavedCounts& saved) {
  std::map<std::string, TaskCounts> counts;
  for (const Task& task : plan.tasks) {
    if (std::find(runs.begin(), runs.end(), task.run) == runs.end()) continue;
    counts.emplace(task_name(plan, task), saved_counts(plan, task, saved));
  }
  return SavedCounts(std::move(counts));
}

std::vector<TaskCounts> task_counts_of(std::size_t run, const Plan& plan,
                                       const SavedCounts& saved) {
  std::vector<TaskCounts> all;
  for (const Task& task : plan.tasks) {
    if (task.run == run) all.push_back(saved_counts(plan, task, saved));
  }
  return all;
}

CollectedCounts collect(const Plan& plan, std::span<const std::size_t> runs,
                        const SavedCounts& saved) {
  CollectedCounts all;
  if (runs.empty()) return all;
  const RunGroup& group = plan.groups[plan.runs[runs.front()].group];
  for (const Condition& condition : group.conditions) {
    const auto add_to = [&](auto& conditions, std::size_t cells) {
      conditions.push_back({condition, {}});
      conditions.back().samples.resize(cells);
    };
    if (group.counts(condition)) add_to(all.counted, group.counted.size());
    if (group.predicts(condition)) add_to(all.scored, group.scored.size());
  }
  for (const Task& task : plan.tasks) {
    if (std::find(runs.begin(), runs.end(), task.run) == runs.end()) continue;
    const TaskCounts found = saved_counts(plan, task, saved);
    if (!found.is_scored()) continue;
    const std::string& simulator = plan.runs[task.run].simulator;
    add_samples(all.counted, found.counted, simulator, task.seed == 0);
    add_samples(all.scored, found.scored, simulator, task.seed == 0);
  }
  return all;
}

}  // namespace touchdown::experiments
