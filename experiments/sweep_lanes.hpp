#pragma once

#include <functional>
#include <span>
#include <vector>

#include "experiments/classification.hpp"
#include "experiments/fitting.hpp"
#include "experiments/heard_run.hpp"
#include "experiments/sweep.hpp"

namespace touchdown {

/// The part of a noise level that an estimator's decisions about the wheels depend on; all else is
/// zero. Levels with the same part need to be listened to only once.
NoiseLevels heard_part(const ContactEstimator& estimator, const NoiseLevels& levels);

/// Whether every step of a run is one that an estimator's signal guard lets pass, at any of these
/// levels: only then may it be replaced by its lanes, which have no guard.
bool needs_no_guard(const HeardRun& run, std::span<const NoiseLevels> levels);

/// Point-wise counts of one estimator under all levels side by side, both wheels added: by level,
/// then piece of the run. Nothing if the estimator has no lanes. `going_on` is asked every few
/// hundred steps. Errors: `Stopped`.
std::vector<Classification> sweep_in_lanes(const ContactEstimator& estimator,
                                           const Condition& condition, const FittedModels& models,
                                           std::span<const NoiseLevels> levels, const HeardRun& run,
                                           const UnitNoise& noise, const ScoringConfig& scoring,
                                           const std::function<bool()>& going_on);

}  // namespace touchdown
