#pragma once

#include <string>

#include "experiments/run_experiment.hpp"
#include "render/heatmap.hpp"

namespace touchdown {

/// One engine's success rates over the noise grid, one panel per estimator.
Heatmap success_heatmap(const ExperimentResult& result, const std::string& simulator);

}  // namespace touchdown
