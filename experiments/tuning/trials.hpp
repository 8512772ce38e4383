#pragma once

#include <cstdint>
#include <vector>

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The hyperparameters of an estimator's trials: its defaults, then random draws within their
/// ranges. Draws depend only on the seed of fitted runs, the estimator's name and the trial's
/// number. They have three digits, so that tables contain them exactly. Empty for an estimator
/// without hyperparameters.
std::vector<HyperparameterValues> trial_hyperparameters(const EstimatorEntry& entry,
                                                        std::uint64_t seed, int trials);

}  // namespace touchdown::experiments
