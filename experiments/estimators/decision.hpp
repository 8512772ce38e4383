#pragma once

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// A small network that is fitted to decide, from channels that one can name.
EstimatorEntry decision_network_entry();

/// The same with weights that are shipped, for who has no labelled runs.
EstimatorEntry shipped_decision_network_entry();

}  // namespace touchdown::experiments
