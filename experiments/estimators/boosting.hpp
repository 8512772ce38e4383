#pragma once

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// Boosted trees, the reference upper bound of a benchmark.
EstimatorEntry gradient_boosting_entry();

}  // namespace touchdown::experiments
