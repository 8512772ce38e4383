#pragma once

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The paper's ablation: the robust measurement model without transitions.
EstimatorEntry measurement_only_entry();

}  // namespace touchdown::experiments
