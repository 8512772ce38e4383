#pragma once

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// What runs on Upkie.
EstimatorEntry upkie_observer_entry();

}  // namespace touchdown::experiments
