#pragma once

#include "core/tables/table.hpp"
#include "experiments/results/result.hpp"

namespace touchdown::experiments {

/// Point-wise scores for other definitions of contact: force thresholds of 0.1, 1, 5 and 10 N, each
/// with debounces of 0, 2, 5 and 10 ms. Noise is the first highlighted setting with its first seed.
/// Estimators stay as fitted; only the truth changes. One row per engine, estimator and definition;
/// intervals over runs. Reads the recordings of the run directory. Errors: `InputError` when one is
/// missing.
Table label_sensitivity_table(const ExperimentResult& result);

}  // namespace touchdown::experiments
