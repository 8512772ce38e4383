#pragma once

#include <span>
#include <vector>

#include "experiments/fitting/make_estimator.hpp"
#include "experiments/rollouts/rollouts.hpp"
#include "scoring/classification.hpp"

namespace touchdown::experiments {

/// Point-wise counts of one run under one noise realisation, both wheels added: by condition, then
/// cell, then piece of the run (`RunSignals::pieces`). Estimators that can listen to many noise
/// levels side by side do; noise on a sensor that an estimator does not use costs nothing. Errors:
/// `Stopped`.
std::vector<scoring::Classification> sweep_run(std::span<const Condition> conditions,
                                               std::span<const noise::NoiseCell> cells,
                                               const RunSignals& run, const NoiseRun& noise,
                                               const FittedModels& models,
                                               const scoring::ScoringConfig& scoring,
                                               const ShouldContinue& should_continue);

/// Of one estimator that listens to one noise level after the other: by level, then piece.
std::vector<scoring::Classification> sweep_levels(ContactEstimator& estimator,
                                                  std::span<const noise::SensorNoise> levels,
                                                  const RunSignals& run, const NoiseRun& noise,
                                                  const scoring::ScoringConfig& scoring,
                                                  const ShouldContinue& should_continue);
std::vector<scoring::Classification> sweep_levels(EstimatorRunner& runner,
                                                  std::span<const noise::SensorNoise> levels,
                                                  const RunSignals& run, const NoiseRun& noise,
                                                  const scoring::ScoringConfig& scoring,
                                                  const ShouldContinue& should_continue);

}  // namespace touchdown::experiments
