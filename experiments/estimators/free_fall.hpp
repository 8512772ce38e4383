#pragma once

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The baseline that anyone would try first.
EstimatorEntry free_fall_entry();

}  // namespace touchdown::experiments
