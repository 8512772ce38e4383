#pragma once

#include <functional>
#include <span>
#include <vector>

#include "experiments/estimators/entry.hpp"
#include "experiments/signals/run_signals.hpp"
#include "scoring/classification.hpp"

namespace touchdown::experiments {

/// Whether an estimator's signal guard would pass every step of a run at all of these levels. Only
/// then can a batch, which has no guard, replace the estimator.
bool needs_no_guard(const RunSignals& run, std::span<const noise::SensorNoise> levels);

/// Point-wise counts of a batch of `count` noise levels on a run, both wheels added: by level, then
/// segment of the run. Calls `should_continue` every few hundred steps. Errors: `Stopped`.
std::vector<scoring::Classification> count_in_batch(const BatchedEstimator& batch,
                                                    std::size_t count, const RunSignals& run,
                                                    const NoiseRun& noise,
                                                    const scoring::ScoringConfig& scoring,
                                                    const std::function<bool()>& should_continue);

}  // namespace touchdown::experiments
