#include "experiments/listening/tasks.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <type_traits>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "experiments/listening/sweep_run.hpp"
#include "experiments/run_directory/saved_state.hpp"
#include "experiments/signals/disturbed.hpp"

namespace touchdown::experiments {

namespace {

// The build is part of a state file's key, so that its numbers may be kept as they lie in memory.
template <typename T>
void append(std::string& bytes, const std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::uint64_t count = values.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof(T));
}

template <typename T>
std::vector<T> take(std::string_view& bytes) {
  std::uint64_t count = 0;
  if (bytes.size() < sizeof count) throw Error("a state file is too short");
  std::memcpy(&count, bytes.data(), sizeof count);
  bytes.remove_prefix(sizeof count);
  if (bytes.size() / sizeof(T) < count) throw Error("a state file is too short");
  std::vector<T> values(count);
  if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
  bytes.remove_prefix(count * sizeof(T));
  return values;
}

/// The noise seeds of a run are one sample: later ones are added to the first one's.
template <typename Sample>
void add_samples(std::vector<Sample>& all, std::span<const Sample> task, bool first_seed) {
  if (first_seed) {
    all.insert(all.end(), task.begin(), task.end());
    return;
  }
  const std::size_t offset = all.size() - task.size();
  for (std::size_t i = 0; i < task.size(); ++i) all[offset + i] += task[i];
}

/// Both wheels of a whole run whose signals are disturbed.
scoring::Classification count(ContactEstimator& estimator, const RunSignals& run,
                              const NoiseRun& noise, const noise::NoiseKey& key,
                              const DisturbedCell& cell, const scoring::ScoringConfig& scoring) {
  const NoiseRun outlying =
      cell.disturbance.heavy_tails ? with_heavy_tails(noise, key) : NoiseRun{};
  const NoiseRun& heard = cell.disturbance.heavy_tails ? outlying : noise;
  const std::size_t skip = scoring::first_scored_step(run.info.control_period_us, scoring);
  scoring::Classification sum;
  estimator.reset();
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const Belief& belief =
        estimator.update(disturbed(run, heard, cell.cell.levels(), k, cell.disturbance));
    for (std::size_t w = 0; w < models::wheel_count && k >= skip; ++w) {
      sum.add(run.contact[w][k] != 0, belief.wheel[w].contact);
    }
  }
  return sum;
}

/// The name of a task's file.
std::string name_of(const Plan& plan, const Task& task) {
  return fmt::format("{}_seed_{:04}",
                     std::filesystem::path(plan.runs[task.run].file).stem().string(), task.seed);
}

/// The next `count` of `rest`, which then begins after them.
template <typename T>
std::span<const T> next(std::span<const T>& rest, std::size_t count) {
  const std::span<const T> taken = rest.first(count);
  rest = rest.subspan(count);
  return taken;
}

}  // namespace

SavedCounts::SavedCounts(std::filesystem::path folder, std::string key)
    : folder_(std::move(folder)), key_(std::move(key)) {}

std::optional<TaskCounts> SavedCounts::read(const Plan& plan, const Task& task) const {
  const std::optional<std::string> bytes = read_state(folder_ / name_of(plan, task), key_);
  if (!bytes) return std::nullopt;
  std::string_view rest = *bytes;
  TaskCounts counts;
  counts.counted = take<scoring::Classification>(rest);
  counts.scored = take<scoring::RobotScore>(rest);
  counts.close = take<scoring::CloseScore>(rest);
  counts.disturbed = take<scoring::Classification>(rest);
  return counts;
}

void SavedCounts::write(const Plan& plan, const Task& task, const TaskCounts& counts) const {
  std::string bytes;
  append(bytes, counts.counted);
  append(bytes, counts.scored);
  append(bytes, counts.close);
  append(bytes, counts.disturbed);
  write_state(folder_ / name_of(plan, task), key_, bytes);
}

TaskCounts listen(const Plan& plan, const Task& task, const RunSignals& run,
                  const scoring::ScoringConfig& scoring, const FittedModels& models,
                  const GoingOn& going_on) {
  const RunGroup& group = plan.group_of(task);
  const std::vector<Condition> conditions = tested_on(group.conditions, run.info.simulator);
  const NoiseRun noise = noise_run(run, task.noise);
  TaskCounts counts;
  if (!group.counted.empty()) {
    counts.counted = sweep_run(conditions, group.counted, run, noise, models, scoring, going_on);
  }
  for (const noise::NoiseCell& cell : group.scored) {
    for (const Condition& condition : conditions) {
      if (!condition.is_fitted_here()) continue;
      if (!going_on()) throw Stopped();
      const auto estimator = make_estimator(condition, models, run);
      const scoring::Prediction prediction = predict(*estimator, run, noise, cell.levels());
      const std::int64_t period_us = run.info.control_period_us;
      const std::vector<scoring::RobotScore> scores =
          scoring::score(run.contact, prediction, run.pieces, period_us, scoring);
      counts.scored.insert(counts.scored.end(), scores.begin(), scores.end());
      if (group.is_looked_at_closely) {
        counts.close.push_back(
            scoring::close_score(run.contact, run.normal_force, prediction, period_us, scoring));
      }
    }
  }
  for (const DisturbedCell& cell : group.disturbed) {
    for (const Condition& condition : conditions) {
      if (!condition.is_fitted_here()) continue;
      if (!going_on()) throw Stopped();
      const auto estimator = make_estimator(condition, models, run);
      counts.disturbed.push_back(count(*estimator, run, noise, task.noise, cell, scoring));
    }
  }
  return counts;
}

std::size_t listen(const Plan& plan, const TaskRange& tasks, const PlayedRuns& runs,
                   const scoring::ScoringConfig& scoring, const FittedModels& models,
                   const SavedCounts& saved, const GoingOn& going_on) {
  Progress progress("listening", "parts", static_cast<std::int64_t>(tasks.size()));
  std::atomic<std::size_t> computed = 0;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(tasks.begin, tasks.end, 1), [&](const auto& range) {
        for (std::size_t t = range.begin(); t < range.end(); ++t) {
          if (!going_on()) throw Stopped();
          const Task& task = plan.tasks[t];
          if (saved.read(plan, task)) {
            progress.skip();
            continue;
          }
          const PlayedRun& run = runs.at(task.run);
          saved.write(plan, task,
                      run.failed() ? TaskCounts{}
                                   : listen(plan, task, run.signals, scoring, models, going_on));
          ++computed;
          progress.advance();
        }
      });
  return computed;
}

std::vector<ConditionCounts> CollectedCounts::own() const {
  std::vector<ConditionCounts> own = counted;
  std::erase_if(own, [](const ConditionCounts& c) { return !c.condition.is_fitted_here(); });
  return own;
}

CollectedCounts collect(const Plan& plan, std::span<const std::size_t> runs,
                        const SavedCounts& saved) {
  CollectedCounts all;
  if (runs.empty()) return all;
  const RunGroup& group = plan.groups[plan.runs[runs.front()].group];
  all.scored.resize(group.scored.size());
  if (group.is_looked_at_closely) all.close.resize(group.scored.size());
  for (const Condition& condition : group.conditions) {
    all.counted.push_back(
        {condition, std::vector<std::vector<scoring::Classification>>(group.counted.size())});
    if (!condition.is_fitted_here()) continue;
    for (auto& scores : all.scored) scores.push_back({condition, {}});
    for (auto& scores : all.close) scores.push_back({condition, {}});
    all.disturbed.push_back(
        {condition, std::vector<std::vector<scoring::Classification>>(group.disturbed.size())});
  }
  for (const Task& task : plan.tasks) {
    if (std::find(runs.begin(), runs.end(), task.run) == runs.end()) continue;
    const std::optional<TaskCounts> found = saved.read(plan, task);
    if (!found) throw Error(fmt::format("the results of {} are missing", name_of(plan, task)));
    if (found->counted.empty() && found->scored.empty()) continue;
    const std::string& simulator = plan.runs[task.run].simulator;
    const std::vector<Condition> here = tested_on(group.conditions, simulator);
    const auto own = static_cast<std::size_t>(std::count_if(
        here.begin(), here.end(), [](const Condition& c) { return c.is_fitted_here(); }));
    const std::size_t pieces = group.counted.empty()
                                   ? found->scored.size() / (own * group.scored.size())
                                   : found->counted.size() / (here.size() * group.counted.size());
    std::span<const scoring::Classification> counts = found->counted;
    std::span<const scoring::RobotScore> scores = found->scored;
    for (ConditionCounts& condition : all.counted) {
      if (condition.condition.test_simulator != simulator) continue;
      for (auto& samples : condition.samples) {
        add_samples(samples, next(counts, pieces), task.seed == 0);
      }
    }
    for (std::vector<ConditionScores>& cell : all.scored) {
      for (ConditionScores& condition : cell) {
        if (condition.condition.test_simulator != simulator) continue;
        add_samples(condition.samples, next(scores, pieces), task.seed == 0);
      }
    }
    std::span<const scoring::CloseScore> close = found->close;
    for (std::vector<ConditionCloseScores>& cell : all.close) {
      for (ConditionCloseScores& condition : cell) {
        if (condition.condition.test_simulator != simulator) continue;
        add_samples(condition.samples, next(close, 1), task.seed == 0);
      }
    }
    std::span<const scoring::Classification> disturbed = found->disturbed;
    for (std::size_t cell = 0; cell < group.disturbed.size(); ++cell) {
      for (ConditionCounts& condition : all.disturbed) {
        if (condition.condition.test_simulator != simulator) continue;
        add_samples(condition.samples[cell], next(disturbed, 1), task.seed == 0);
      }
    }
  }
  return all;
}

}  // namespace touchdown::experiments
