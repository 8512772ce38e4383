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
#include "experiments/odometry/contact_sources.hpp"
#include "experiments/odometry/dead_reckoning.hpp"
#include "experiments/run_directory/saved_state.hpp"

namespace touchdown::experiments {

namespace {

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

/// Calls `part(counts, ...)` for each of the four lists that belong to cells.
template <typename Part, typename... Counts>
void for_each_part(const Part& part, Counts&... counts) {
  part(counts.counted...);
  part(counts.scored...);
  part(counts.extended...);
  part(counts.disturbed...);
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

/// Counts of both wheels over a whole run with disturbed signals.
scoring::Classification count(EstimatorRunner& runner, const RunSignals& run, const NoiseRun& noise,
                              const noise::NoiseKey& key, const DisturbedCell& cell,
                              const scoring::ScoringConfig& scoring) {
  const NoiseRun draws = cell.disturbance.heavy_tails ? with_heavy_tails(noise, key) : noise;
  const std::size_t skip = scoring::first_scored_step(run.info.control_period_us, scoring);
  scoring::Classification sum;
  runner.run_estimator(
      run,
      [&](std::size_t k) { return disturbed(run, draws, cell.cell.levels(), k, cell.disturbance); },
      [&](std::size_t k, const Belief& belief) {
        for (std::size_t w = 0; w < models::wheel_count && k >= skip; ++w) {
          sum.add(run.contact[w][k] != 0, belief.wheel[w].contact);
        }
      });
  return sum;
}

/// Scores an estimator's own decisions, then its decisions at each operating point.
void add_operating_scores(const RunSignals& run, const scoring::Prediction& prediction,
                          const OperatingPointsConfig& config,
                          const scoring::ScoringConfig& scoring, TaskCounts& counts) {
  using Decided = std::array<scoring::ContactSequence, models::wheel_count>;
  const auto add = [&](const Decided& decided) {
    counts.operating.push_back(
        scoring::operating_score(run.contact, decided, run.info.control_period_us, scoring));
  };
  add({prediction[0].contact, prediction[1].contact});
  for (const scoring::Hysteresis& point : points_of(config)) {
    add({scoring::decisions(prediction[0].p_contact, point),
         scoring::decisions(prediction[1].p_contact, point)});
  }
}

}  // namespace

std::string to_bytes(const TaskCounts& counts) {
  std::string bytes;
  for_each_part([&](const auto& part) { append(bytes, part); }, counts);
  append(bytes, counts.odometry);
  append(bytes, counts.operating);
  return bytes;
}

TaskCounts take_counts(std::string_view& bytes) {
  TaskCounts counts;
  for_each_part([&](auto& part) { take(part, bytes); }, counts);
  take(counts.odometry, bytes);
  take(counts.operating, bytes);
  return counts;
}

void add_scores(const RunSignals& run, const scoring::Prediction& prediction,
                const scoring::ScoringConfig& scoring, bool has_extended_scores,
                TaskCounts& counts) {
  const std::int64_t period_us = run.info.control_period_us;
  const std::vector<scoring::RobotScore> scores =
      scoring::score(run.contact, prediction, run.segments, period_us, scoring);
  counts.scored.insert(counts.scored.end(), scores.begin(), scores.end());
  if (!has_extended_scores) return;
  counts.extended.push_back(
      scoring::extended_score(run.contact, run.normal_force, prediction, period_us, scoring));
}

std::string task_name(const Plan& plan, const Task& task) {
  const PlannedRun& run = plan.runs[task.run];
  const std::string& sensors = plan.sensors[run.sensors].name;
  return fmt::format("{}{}{}_seed_{:04}", std::filesystem::path(run.file).stem().string(),
                     sensors.empty() ? "" : "_", sensors, task.seed);
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

TaskCounts evaluate(const Plan& plan, const Task& task, const RunSignals& run,
                    const Experiment& experiment, const FittedModels& models,
                    const ShouldContinue& should_continue) {
  const scoring::ScoringConfig& scoring = experiment.scoring;
  const RunGroup& group = plan.group_of(task);
  const std::vector<Condition> conditions = tested_on(group.conditions, run.info.simulator);
  const NoiseRun noise = noise_run(run, task.noise);
  TaskCounts counts;
  std::vector<Condition> counted = conditions;
  std::erase_if(counted, [&](const Condition& one) { return !group.counts(one); });
  counts.counted =
      sweep_run(counted, group.counted, run, noise, models, experiment, should_continue);
  const auto add_odometry = [&](const TrackView& p_contact) {
    if (!should_continue()) throw Stopped();
    counts.odometry.push_back(
        score_odometry(run, noise, group.scored.front().levels(), p_contact, scoring));
  };
  if (group.odometry) {
    for (const ContactTrack& contact : oracle_tracks(*group.odometry, run)) {
      add_odometry({contact[0], contact[1]});
    }
  }
  for (const Condition& condition : conditions) {
    if (!group.scores(condition)) continue;
    EstimatorRunner runner = runner_of(experiment, condition, models, run);
    for (const noise::NoiseCell& cell : group.scored) {
      if (!should_continue()) throw Stopped();
      const scoring::Prediction prediction = predict(runner, run, noise, cell.levels());
      add_scores(run, prediction, scoring, group.has_extended_scores && condition.refit == 0,
                 counts);
      if (group.tries_points(condition)) {
        add_operating_scores(run, prediction, *group.operating_points, scoring, counts);
      }
      if (&cell == &group.scored.front() && group.feeds_odometry(condition)) {
        add_odometry({prediction[0].p_contact, prediction[1].p_contact});
      }
    }
    if (condition.refit > 0) continue;
    for (const DisturbedCell& cell : group.disturbed) {
      if (!should_continue()) throw Stopped();
      counts.disturbed.push_back(count(runner, run, noise, task.noise, cell, scoring));
    }
  }
  return counts;
}

std::size_t evaluate(const Plan& plan, const TaskRange& tasks, const Rollouts& runs,
                     const Experiment& experiment, const FittedModels& models,
                     const SavedCounts& saved, const ShouldContinue& should_continue) {
  Progress progress("evaluating", "parts", static_cast<std::int64_t>(tasks.size()));
  std::atomic<std::size_t> computed = 0;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(tasks.begin, tasks.end, 1), [&](const auto& range) {
        for (std::size_t t = range.begin(); t < range.end(); ++t) {
          if (!should_continue()) throw Stopped();
          const Task& task = plan.tasks[t];
          if (saved.read(plan, task)) {
            progress.skip();
            continue;
          }
          const Rollout& run = runs.at(task.run);
          saved.write(plan, task,
                      run.failed()
                          ? TaskCounts{}
                          : evaluate(plan, task, run.signals, experiment, models, should_continue));
          ++computed;
          progress.advance();
        }
      });
  return computed;
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
    if (!group.scores(condition)) continue;
    add_to(all.scored, group.scored.size());
    if (condition.refit > 0) continue;
    add_to(all.extended, group.has_extended_scores ? group.scored.size() : 0);
    add_to(all.disturbed, group.disturbed.size());
  }
  for (const Task& task : plan.tasks) {
    if (std::find(runs.begin(), runs.end(), task.run) == runs.end()) continue;
    const TaskCounts found = saved_counts(plan, task, saved);
    if (found.counted.empty() && found.scored.empty()) continue;
    const std::string& simulator = plan.runs[task.run].simulator;
    for_each_part(
        [&](auto& sums, const auto& part) { add_samples(sums, part, simulator, task.seed == 0); },
        all, found);
  }
  return all;
}

}  // namespace touchdown::experiments
