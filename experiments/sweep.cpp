#include "experiments/sweep.hpp"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "core/random.hpp"
#include "experiments/estimator_registry.hpp"
#include "experiments/stopped.hpp"
#include "experiments/sweep_run.hpp"

namespace touchdown {

namespace {

/// One run under one noise seed, heard by all conditions that are tested on its engine.
struct Task {
  const HeardRun* run = nullptr;
  int seed = 0;
  std::vector<std::size_t> conditions;
};

/// By run, then seed: the order in which results are added up.
std::vector<Task> tasks_of(const std::vector<Condition>& conditions,
                           const std::vector<const HeardRun*>& runs, int seeds) {
  std::vector<Task> tasks;
  for (const HeardRun* run : runs) {
    std::vector<std::size_t> listening;
    for (std::size_t c = 0; c < conditions.size(); ++c) {
      if (conditions[c].test_simulator == run->info.simulator) listening.push_back(c);
    }
    for (int seed = 0; seed < seeds; ++seed) tasks.push_back({run, seed, listening});
  }
  return tasks;
}

template <typename Work>
void in_parallel(std::size_t count, const Work& work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) work(i);
  });
}

/// Adds one task's samples to those of its run: the noise seeds of a run are one sample.
template <typename Sample>
void add_samples(std::vector<Sample>& all, std::span<const Sample> task, bool first_seed) {
  if (first_seed) {
    all.insert(all.end(), task.begin(), task.end());
    return;
  }
  const std::size_t offset = all.size() - task.size();
  for (std::size_t i = 0; i < task.size(); ++i) all[offset + i] += task[i];
}

}  // namespace

std::vector<NoiseCell> noise_cells(const NoiseGridConfig& noise) {
  std::vector<NoiseCell> cells;
  for (const double torque : noise.torque) {
    for (const double accelerometer : noise.accelerometer) cells.push_back({torque, accelerometer});
  }
  const KneeWheelGridConfig& grid = noise.knee_wheel;
  for (const double knee : grid.knee) {
    for (const double wheel : grid.wheel) {
      const NoiseCell cell = knee_wheel_cell(knee, wheel, grid.accelerometer);
      if (std::find(cells.begin(), cells.end(), cell) == cells.end()) cells.push_back(cell);
    }
  }
  for (NoiseCell& cell : cells) cell = with_encoder_noise(cell, noise);
  return cells;
}

std::vector<Condition> own_engine_conditions(const Experiment& experiment) {
  std::vector<Condition> conditions;
  for (const std::string& simulator : experiment.simulators) {
    for (const std::string& estimator : experiment.estimators) {
      if (estimator != always_contact_name) conditions.push_back({simulator, simulator, estimator});
    }
    conditions.push_back({simulator, simulator, std::string(always_contact_name)});
  }
  return conditions;
}

NoiseKey noise_key(const Experiment& experiment, int noise_seed, std::int64_t run) {
  constexpr std::uint64_t noise_stream = 0x6e6f697365;  // "noise"
  const auto bits = philox(experiment.seed, noise_stream, static_cast<std::uint64_t>(noise_seed));
  return {.seed = (std::uint64_t{bits[0]} << 32U) | bits[1],
          .run = static_cast<std::uint64_t>(run)};
}

std::unique_ptr<ContactEstimator> make_estimator(const Condition& condition,
                                                 const FittedModels& models,
                                                 std::int64_t control_period_us) {
  const EstimatorEntry& entry = estimator_entry(condition.estimator);
  const FittedModel* model = entry.config || entry.phase
                                 ? &models.at(condition.fit_simulator).at(condition.estimator)
                                 : nullptr;
  return entry.make(entry, model, 1e6 / static_cast<double>(control_period_us));
}

std::int64_t sweep_size(const Experiment& experiment, const std::vector<Condition>& conditions,
                        const std::vector<NoiseCell>& cells,
                        const std::vector<const HeardRun*>& test_runs) {
  std::size_t size = 0;
  for (const Task& task : tasks_of(conditions, test_runs, experiment.noise.seeds)) {
    size += task.conditions.size() * cells.size();
  }
  return static_cast<std::int64_t>(size);
}

std::vector<ConditionCounts> sweep(const Experiment& experiment,
                                   const std::vector<Condition>& conditions,
                                   const std::vector<NoiseCell>& cells,
                                   const std::vector<const HeardRun*>& test_runs,
                                   const FittedModels& models, const SweepProgress& progress) {
  const std::vector<Task> tasks = tasks_of(conditions, test_runs, experiment.noise.seeds);
  std::vector<std::vector<Classification>> counts(tasks.size());
  in_parallel(tasks.size(), [&](std::size_t t) {
    const Task& task = tasks[t];
    std::vector<Condition> listening;
    for (const std::size_t c : task.conditions) listening.push_back(conditions[c]);
    const UnitNoise noise =
        unit_noise(*task.run, noise_key(experiment, task.seed, task.run->info.run));
    counts[t] = sweep_run(listening, cells, *task.run, noise, models, experiment.scoring,
                          [&] { return progress(0); });
    if (!progress(static_cast<std::int64_t>(listening.size() * cells.size()))) throw Stopped();
  });

  std::vector<ConditionCounts> result;
  for (const Condition& condition : conditions) {
    result.push_back({condition, std::vector<std::vector<Classification>>(cells.size())});
  }
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    std::span<const Classification> rest = counts[t];
    const std::size_t pieces = tasks[t].run->pieces.size();
    for (const std::size_t c : tasks[t].conditions) {
      for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        add_samples(result[c].samples[cell], rest.first(pieces), tasks[t].seed == 0);
        rest = rest.subspan(pieces);
      }
    }
  }
  return result;
}

std::vector<ConditionScores> score_conditions(const Experiment& experiment,
                                              const std::vector<Condition>& conditions,
                                              const NoiseCell& cell, int seeds,
                                              const std::vector<const HeardRun*>& test_runs,
                                              const FittedModels& models,
                                              const SweepProgress& progress) {
  const std::vector<Task> tasks = tasks_of(conditions, test_runs, seeds);
  // By task, then condition of the task.
  std::vector<std::vector<std::vector<RobotScore>>> scores(tasks.size());
  in_parallel(tasks.size(), [&](std::size_t t) {
    const HeardRun& run = *tasks[t].run;
    const UnitNoise noise = unit_noise(run, noise_key(experiment, tasks[t].seed, run.info.run));
    for (const std::size_t c : tasks[t].conditions) {
      const auto estimator = make_estimator(conditions[c], models, run.info.control_period_us);
      scores[t].push_back(score(run.contact, predict(*estimator, run, noise, cell.levels()),
                                run.pieces, run.info.control_period_us, experiment.scoring));
      if (!progress(1)) throw Stopped();
    }
  });
  std::vector<ConditionScores> result;
  for (const Condition& condition : conditions) result.push_back({condition, {}});
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    for (std::size_t i = 0; i < tasks[t].conditions.size(); ++i) {
      const std::vector<RobotScore>& samples = scores[t][i];
      add_samples<RobotScore>(result[tasks[t].conditions[i]].samples, samples, tasks[t].seed == 0);
    }
  }
  return result;
}

}  // namespace touchdown
