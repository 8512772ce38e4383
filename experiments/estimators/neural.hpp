#pragma once

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The paper's neural measurement network, as it is shipped.
EstimatorEntry neural_entry();

}  // namespace touchdown::experiments
