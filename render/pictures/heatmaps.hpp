#pragma once

#include <atomic>
#include <vector>

#include "experiments/results/result.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws maps of the error rate into the run directory, for every engine: over the noise grid with
/// one panel per estimator, and over knee and wheel torque noise if there is such a grid.
std::vector<Figure> draw_heatmaps(const experiments::ExperimentResult& result,
                                  const std::atomic<bool>* stop);

}  // namespace touchdown::render
