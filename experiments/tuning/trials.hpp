#pragma once

#include <cstdint>
#include <vector>

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The constants of an estimator's trials: its defaults, then draws within the ranges of its
/// choices, which depend on the seed of fitted runs, the estimator's name and their number alone.
/// Drawn numbers have three digits, so that a table has them whole. None for an estimator without
/// choices.
std::vector<HyperparameterValues> trial_hyperparameters(const EstimatorEntry& entry, std::uint64_t seed, int trials);

}  // namespace touchdown::experiments
