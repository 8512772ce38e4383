#pragma once

#include <span>
#include <vector>

#include "experiments/fitting/fitting.hpp"
#include "experiments/rollouts/rollouts.hpp"
#include "scoring/classification.hpp"

namespace touchdown::experiments {

/// Point-wise counts of one run with one noise realisation, both wheels added: by condition, then
/// cell, then segment of the run (`RunSignals::segments`). Estimators with a batched form process
/// all noise levels at once. Noise on a sensor that an estimator does not use costs no time.
/// Errors: `Stopped`.
std::vector<scoring::Classification> sweep_run(std::span<const Condition> conditions,
                                               std::span<const noise::NoiseCell> cells,
                                               const RunSignals& run, const NoiseRun& noise,
                                               const FittedModels& models,
                                               const Experiment& experiment,
                                               const ShouldContinue& should_continue);

/// The counts of one estimator that processes the noise levels one by one: by level, then segment.
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
