#pragma once

#include "core/table.hpp"
#include "experiments/results/result.hpp"

namespace touchdown::experiments {

/// How point-wise scores move when contact is defined otherwise: force thresholds of 0.1, 1, 5 and
/// 10 N, each with debounces of 0, 2, 5 and 10 ms, at the first highlighted noise setting and its
/// first noise seed. Estimators stay as they were fitted, so that only the truth changes. One row
/// per engine, estimator and definition; intervals over runs. Reads the recordings of the run
/// directory. Errors: `InputError` when one is missing.
Table label_sensitivity_table(const ExperimentResult& result);

}  // namespace touchdown::experiments
