#include "experiments/listening/sweep_run.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "experiments/listening/sweep_lanes.hpp"

namespace touchdown::experiments {

namespace {

/// The noise levels that differ for an estimator with these sensors, and which of them each cell
/// has.
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
                                                     const GoingOn& going_on) {
  const std::size_t pieces = run.pieces.size();
  std::vector<scoring::Classification> counts(levels.size() * pieces);
  for (std::size_t level = 0; level < levels.size(); ++level) {
    if (!going_on()) throw Stopped();
    const auto decisions = decide(estimator, run, noise, levels[level]);
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      const auto of_wheel = scoring::classify(run.contact[wheel], decisions[wheel], run.pieces,
                                              run.info.control_period_us, scoring);
      for (std::size_t i = 0; i < pieces; ++i) counts[level * pieces + i] += of_wheel[i];
    }
  }
  return counts;
}

}  // namespace

std::vector<scoring::Classification> sweep_levels(ContactEstimator& estimator,
                                                  std::span<const noise::SensorNoise> levels,
                                                  const RunSignals& run, const NoiseRun& noise,
                                                  const scoring::ScoringConfig& scoring,
                                                  const GoingOn& going_on) {
  return counts_by_level(estimator, levels, run, noise, scoring, going_on);
}

std::vector<scoring::Classification> sweep_levels(Listener& listener,
                                                  std::span<const noise::SensorNoise> levels,
                                                  const RunSignals& run, const NoiseRun& noise,
                                                  const scoring::ScoringConfig& scoring,
                                                  const GoingOn& going_on) {
  return counts_by_level(listener, levels, run, noise, scoring, going_on);
}

std::vector<scoring::Classification> sweep_run(std::span<const Condition> conditions,
                                               std::span<const noise::NoiseCell> cells,
                                               const RunSignals& run, const NoiseRun& noise,
                                               const FittedModels& models,
                                               const scoring::ScoringConfig& scoring,
                                               const GoingOn& going_on) {
  const std::vector<noise::SensorNoise> all_levels = levels_of(cells);
  const bool lanes_apply = needs_no_guard(run, all_levels);
  const std::size_t pieces = run.pieces.size();
  std::vector<scoring::Classification> counts;
  counts.reserve(conditions.size() * cells.size() * pieces);
  for (const Condition& condition : conditions) {
    const EstimatorEntry entry = entry_of(condition, models);
    const EstimatorSetup setup = setup_of(condition, models, run);
    const DifferentLevels levels(entry.sensors, all_levels);
    std::optional<EstimatorLanes> lanes;
    if (lanes_apply && entry.lanes != nullptr) lanes = entry.lanes(entry, setup, levels.different);
    const auto one_by_one = [&] {
      Listener listener = listener_of(entry, setup);
      return sweep_levels(listener, levels.different, run, noise, scoring, going_on);
    };
    const std::vector<scoring::Classification> by_level =
        lanes ? count_in_lanes(*lanes, levels.different.size(), run, noise, scoring, going_on)
              : one_by_one();
    for (const std::size_t level : levels.of_cell) {
      const auto first = by_level.begin() + static_cast<std::ptrdiff_t>(level * pieces);
      counts.insert(counts.end(), first, first + static_cast<std::ptrdiff_t>(pieces));
    }
  }
  return counts;
}

}  // namespace touchdown::experiments
