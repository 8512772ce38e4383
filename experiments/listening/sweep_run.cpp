#include "experiments/listening/sweep_run.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/listening/sweep_lanes.hpp"

namespace touchdown::experiments {

namespace {

void add_to(std::span<scoring::Classification> pieces, const RunSignals& run,
            const std::array<scoring::ContactSequence, models::wheel_count>& decisions,
            const scoring::ScoringConfig& scoring) {
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    const auto counts = scoring::classify(run.contact[wheel], decisions[wheel], run.pieces,
                                          run.info.control_period_us, scoring);
    for (std::size_t i = 0; i < pieces.size(); ++i) pieces[i] += counts[i];
  }
}

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

}  // namespace

std::vector<scoring::Classification> sweep_levels(ContactEstimator& estimator,
                                                  std::span<const noise::SensorNoise> levels,
                                                  const RunSignals& run, const NoiseRun& noise,
                                                  const scoring::ScoringConfig& scoring,
                                                  const GoingOn& going_on) {
  const std::size_t pieces = run.pieces.size();
  std::vector<scoring::Classification> counts(levels.size() * pieces);
  std::span<scoring::Classification> rest = counts;
  for (const noise::SensorNoise& level : levels) {
    if (!going_on()) throw Stopped();
    add_to(rest.first(pieces), run, decide(estimator, run, noise, level), scoring);
    rest = rest.subspan(pieces);
  }
  return counts;
}

std::vector<scoring::Classification> sweep_run_one_by_one(
    std::span<const Condition> conditions, std::span<const noise::NoiseCell> cells,
    const RunSignals& run, const NoiseRun& noise, const FittedModels& models,
    const scoring::ScoringConfig& scoring, const GoingOn& going_on) {
  const std::vector<noise::SensorNoise> levels = levels_of(cells);
  std::vector<scoring::Classification> counts;
  for (const Condition& condition : conditions) {
    const auto estimator = make_estimator(condition, models, run);
    const auto by_level = sweep_levels(*estimator, levels, run, noise, scoring, going_on);
    counts.insert(counts.end(), by_level.begin(), by_level.end());
  }
  return counts;
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
    const EstimatorEntry& entry = estimator_entry(condition.estimator);
    const EstimatorSetup setup = setup_of(condition, models, run);
    const DifferentLevels levels(entry.sensors, all_levels);
    std::optional<EstimatorLanes> lanes;
    if (lanes_apply && entry.lanes != nullptr) lanes = entry.lanes(entry, setup, levels.different);
    const std::vector<scoring::Classification> by_level =
        lanes ? count_in_lanes(*lanes, levels.different.size(), run, noise, scoring, going_on)
              : sweep_levels(*entry.make(entry, setup), levels.different, run, noise, scoring,
                             going_on);
    for (const std::size_t level : levels.of_cell) {
      const auto first = by_level.begin() + static_cast<std::ptrdiff_t>(level * pieces);
      counts.insert(counts.end(), first, first + static_cast<std::ptrdiff_t>(pieces));
    }
  }
  return counts;
}

}  // namespace touchdown::experiments
