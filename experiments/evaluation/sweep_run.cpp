#include "experiments/evaluation/sweep_run.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "experiments/evaluation/sweep_batch.hpp"

namespace touchdown::experiments {

namespace {

/// The noise levels that differ for an estimator with these sensors, and the index of each cell's
/// level among them.
struct DifferentLevels {
  DifferentLevels(const Sensors& sensors, std::span<const noise::SensorNoise> levels) {
    for (const noise::SensorNoise& level : levels) {
      const noise::SensorNoise part = noise_of(sensors, level);
      const auto known = std::find(different.begin(), different.end(), part);
      of_cell.push_back(static_cast<std::size_t>(known - different.begin()));
      if (known == different.end()) different.push_back(part);
    }
  }

  std::vector<noise::SensorNoise> different;
  std::vector<std::size_t> of_cell;
};

std::vector<noise::SensorNoise> levels_of(std::span<const noise::NoiseCell> cells) {
  std::vector<noise::SensorNoise> levels;
  for (const noise::NoiseCell& cell : cells) levels.push_back(cell.levels());
  return levels;
}

template <typename Estimator>
std::vector<scoring::Classification> counts_by_level(Estimator& estimator,
                                                     std::span<const noise::SensorNoise> levels,
                                                     const RunSignals& run, const NoiseRun& noise,
                                                     const scoring::ScoringConfig& scoring,
                                                     const ShouldContinue& should_continue) {
  const std::size_t segments = run.segments.size();
  std::vector<scoring::Classification> counts(levels.size() * segments);
  for (std::size_t level = 0; level < levels.size(); ++level) {
    if (!should_continue()) throw Stopped();
    const auto decisions = decide(estimator, run, noise, levels[level]);
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      const auto of_wheel = scoring::classify(run.contact[wheel], decisions[wheel], run.segments,
                                              run.info.control_period_us, scoring);
      for (std::size_t i = 0; i < segments; ++i) counts[level * segments + i] += of_wheel[i];
    }
  }
  return counts;
}

}  // namespace

std::vector<scoring::Classification> sweep_levels(ContactEstimator& estimator,
                                                  std::span<const noise::SensorNoise> levels,
                                                  const RunSignals& run, const NoiseRun& noise,
                                                  const scoring::ScoringConfig& scoring,
                                                  const ShouldContinue& should_continue) {
  return counts_by_level(estimator, levels, run, noise, scoring, should_continue);
}

std::vector<scoring::Classification> sweep_levels(EstimatorRunner& runner,
                                                  std::span<const noise::SensorNoise> levels,
                                                  const RunSignals& run, const NoiseRun& noise,
                                                  const scoring::ScoringConfig& scoring,
                                                  const ShouldContinue& should_continue) {
  return counts_by_level(runner, levels, run, noise, scoring, should_continue);
}

std::vector<scoring::Classification> sweep_run(std::span<const Condition> conditions,
                                               std::span<const noise::NoiseCell> cells,
                                               const RunSignals& run, const NoiseRun& noise,
                                               const FittedModels& models,
                                               const Experiment& experiment,
                                               const ShouldContinue& should_continue) {
  const scoring::ScoringConfig& scoring = experiment.scoring;
  const std::vector<noise::SensorNoise> all_levels = levels_of(cells);
  const bool can_batch = needs_no_guard(run, all_levels);
  const std::size_t segments = run.segments.size();
  std::vector<scoring::Classification> counts;
  counts.reserve(conditions.size() * cells.size() * segments);
  for (const Condition& condition : conditions) {
    const EstimatorEntry entry = entry_of(experiment, condition, models);
    const EstimatorSetup setup = setup_of(experiment, condition, models, run);
    const DifferentLevels levels(entry.sensors, all_levels);
    std::optional<BatchedEstimator> batch;
    if (can_batch && entry.batch != nullptr) batch = entry.batch(entry, setup, levels.different);
    const auto one_by_one = [&] {
      EstimatorRunner runner = runner_of(entry, setup);
      return sweep_levels(runner, levels.different, run, noise, scoring, should_continue);
    };
    const std::vector<scoring::Classification> by_level =
        batch
            ? count_in_batch(*batch, levels.different.size(), run, noise, scoring, should_continue)
            : one_by_one();
    for (const std::size_t level : levels.of_cell) {
      const auto first = by_level.begin() + static_cast<std::ptrdiff_t>(level * segments);
      counts.insert(counts.end(), first, first + static_cast<std::ptrdiff_t>(segments));
    }
  }
  return counts;
}

}  // namespace touchdown::experiments
