#pragma once

#include <vector>

#include "experiments/results/result.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws into the run directory, for every engine: error rates over the noise grid, one panel per
/// estimator, and the same over knee and wheel torque noise if there is such a grid.
std::vector<Figure> draw_heatmaps(const experiments::ExperimentResult& result);

}  // namespace touchdown::render
