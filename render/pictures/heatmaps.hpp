#pragma once

#include <optional>
#include <string>

#include "experiments/tables/result.hpp"
#include "render/maps/heatmap.hpp"

namespace touchdown::render {

/// One engine's success rates over the noise grid, one panel per estimator.
Heatmap success_heatmap(const experiments::ExperimentResult& result, const std::string& simulator);

/// The same over knee and wheel torque noise; nothing without such a grid.
std::optional<Heatmap> knee_wheel_heatmap(const experiments::ExperimentResult& result,
                                          const std::string& simulator);

}  // namespace touchdown::render
