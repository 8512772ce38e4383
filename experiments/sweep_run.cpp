#include "experiments/sweep_run.hpp"

#include "experiments/stopped.hpp"

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

}  // namespace

std::vector<Classification> sweep_run_one_by_one(std::span<const Condition> conditions,
                                                 std::span<const NoiseCell> cells,
                                                 const HeardRun& run, const UnitNoise& noise,
                                                 const FittedModels& models,
                                                 const ScoringConfig& scoring,
                                                 const GoingOn& going_on) {
  const std::size_t pieces = run.pieces.size();
  std::vector<Classification> counts(conditions.size() * cells.size() * pieces);
  std::span<Classification> rest = counts;
  for (const Condition& condition : conditions) {
    const auto estimator = make_estimator(condition, models, run.info.control_period_us);
    for (const NoiseCell& cell : cells) {
      if (!going_on()) throw Stopped();
      add_to(rest.first(pieces), run, decide(*estimator, run, noise, cell.levels()), scoring);
      rest = rest.subspan(pieces);
    }
  }
  return counts;
}

std::vector<Classification> sweep_run(std::span<const Condition> conditions,
                                      std::span<const NoiseCell> cells, const HeardRun& run,
                                      const UnitNoise& noise, const FittedModels& models,
                                      const ScoringConfig& scoring, const GoingOn& going_on) {
  return sweep_run_one_by_one(conditions, cells, run, noise, models, scoring, going_on);
}

}  // namespace touchdown
