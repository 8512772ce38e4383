#include "experiments/sweep_run.hpp"

#include <algorithm>

#include "experiments/stopped.hpp"
#include "experiments/sweep_lanes.hpp"

namespace touchdown {

namespace {

void add_to(std::span<Classification> pieces, const HeardRun& run,
            const std::array<ContactSequence, wheel_count>& decisions,
            const ScoringConfig& scoring) {
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    const auto counts = classify(run.contact[wheel], decisions[wheel], run.pieces,
                                 run.info.control_period_us, scoring);
    for (std::size_t i = 0; i < pieces.size(); ++i) pieces[i] += counts[i];
  }
}

/// One level after the other: by level, then piece.
std::vector<Classification> one_by_one(ContactEstimator& estimator,
                                       std::span<const NoiseLevels> levels, const HeardRun& run,
                                       const UnitNoise& noise, const ScoringConfig& scoring,
                                       const GoingOn& going_on) {
  const std::size_t pieces = run.pieces.size();
  std::vector<Classification> counts(levels.size() * pieces);
  std::span<Classification> rest = counts;
  for (const NoiseLevels& level : levels) {
    if (!going_on()) throw Stopped();
    add_to(rest.first(pieces), run, decide(estimator, run, noise, level), scoring);
    rest = rest.subspan(pieces);
  }
  return counts;
}

/// The noise levels that sound different to an estimator, and which of them each cell has.
struct DifferentLevels {
  DifferentLevels(const ContactEstimator& estimator, std::span<const NoiseLevels> levels) {
    for (const NoiseLevels& level : levels) {
      const NoiseLevels heard = heard_part(estimator, level);
      const auto known = std::find(different.begin(), different.end(), heard);
      of_cell.push_back(static_cast<std::size_t>(known - different.begin()));
      if (known == different.end()) different.push_back(heard);
    }
  }

  std::vector<NoiseLevels> different;
  std::vector<std::size_t> of_cell;
};

}  // namespace

std::vector<Classification> sweep_run_one_by_one(std::span<const Condition> conditions,
                                                 std::span<const NoiseCell> cells,
                                                 const HeardRun& run, const UnitNoise& noise,
                                                 const FittedModels& models,
                                                 const ScoringConfig& scoring,
                                                 const GoingOn& going_on) {
  std::vector<NoiseLevels> levels;
  for (const NoiseCell& cell : cells) levels.push_back(cell.levels());
  std::vector<Classification> counts;
  for (const Condition& condition : conditions) {
    const auto estimator = make_estimator(condition, models, run.info.control_period_us);
    const auto by_level = one_by_one(*estimator, levels, run, noise, scoring, going_on);
    counts.insert(counts.end(), by_level.begin(), by_level.end());
  }
  return counts;
}

std::vector<Classification> sweep_run(std::span<const Condition> conditions,
                                      std::span<const NoiseCell> cells, const HeardRun& run,
                                      const UnitNoise& noise, const FittedModels& models,
                                      const ScoringConfig& scoring, const GoingOn& going_on) {
  std::vector<NoiseLevels> all_levels;
  for (const NoiseCell& cell : cells) all_levels.push_back(cell.levels());
  const bool lanes_apply = needs_no_guard(run, all_levels);
  const std::size_t pieces = run.pieces.size();
  std::vector<Classification> counts;
  counts.reserve(conditions.size() * cells.size() * pieces);
  for (const Condition& condition : conditions) {
    const auto estimator = make_estimator(condition, models, run.info.control_period_us);
    const DifferentLevels levels(*estimator, all_levels);
    std::vector<Classification> by_level;
    if (lanes_apply) {
      by_level = sweep_in_lanes(*estimator, condition, models, levels.different, run, noise,
                                scoring, going_on);
    }
    if (by_level.empty()) {
      by_level = one_by_one(*estimator, levels.different, run, noise, scoring, going_on);
    }
    for (const std::size_t level : levels.of_cell) {
      const auto first = by_level.begin() + static_cast<std::ptrdiff_t>(level * pieces);
      counts.insert(counts.end(), first, first + static_cast<std::ptrdiff_t>(pieces));
    }
  }
  return counts;
}

}  // namespace touchdown
