#pragma once

#include <functional>
#include <span>
#include <vector>

#include "experiments/estimators/entry.hpp"
#include "experiments/signals/run_signals.hpp"
#include "scoring/classification.hpp"

namespace touchdown::experiments {

/// Whether every step of a run is one that an estimator's signal guard lets pass, at any of these
/// levels: only then may it be replaced by its lanes, which have no guard.
bool needs_no_guard(const RunSignals& run, std::span<const noise::SensorNoise> levels);

/// Point-wise counts of so many lanes that listen to a run, both wheels added: by lane, then piece
/// of the run. `should_continue` is asked every few hundred steps. Errors: `Stopped`.
std::vector<scoring::Classification> count_in_batch(const BatchedEstimator& lanes, std::size_t count,
                                                    const RunSignals& run, const NoiseRun& noise,
                                                    const scoring::ScoringConfig& scoring,
                                                    const std::function<bool()>& should_continue);

}  // namespace touchdown::experiments
