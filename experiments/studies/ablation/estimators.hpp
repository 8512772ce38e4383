#pragma once

#include <vector>

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The estimators that only this study has: the configurations between `paper` and `robust`
/// (estimator/bayes/ablation.hpp), and `hmm` without memory. Each differs from its neighbours by
/// one change; none is meant for a robot.
std::vector<EstimatorEntry> ablation_estimators();

}  // namespace touchdown::experiments
