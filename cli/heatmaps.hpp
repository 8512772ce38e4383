#pragma once

#include <optional>
#include <string>

#include "experiments/run_experiment.hpp"
#include "render/heatmap.hpp"

namespace touchdown {

/// One engine's success rates over the noise grid, one panel per estimator.
Heatmap success_heatmap(const ExperimentResult& result, const std::string& simulator);

/// The same over knee and wheel torque noise; nothing without such a grid.
std::optional<Heatmap> knee_wheel_heatmap(const ExperimentResult& result,
                                          const std::string& simulator);

}  // namespace touchdown
