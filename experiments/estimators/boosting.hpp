#pragma once

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The learned ceiling that a benchmark measures others against.
EstimatorEntry gradient_boosting_entry();

}  // namespace touchdown::experiments
