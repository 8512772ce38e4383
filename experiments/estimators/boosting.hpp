#pragma once

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// Boosted trees, the reference upper bounds of a benchmark: on the channels of the recommended
/// estimator, and on all raw signals with the torques by the laws of the servos.
EstimatorEntry boosted_channels_entry();
EstimatorEntry boosted_signals_entry();

}  // namespace touchdown::experiments
