#pragma once

#include <vector>

#include "experiments/results/result.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws into the run directory, for every engine: the measurement models that were fitted to its
/// runs, and, at the highlighted noise settings with both wheels pooled, reliability curves and
/// latencies. What an experiment has nothing of is left out.
std::vector<Figure> draw_score_figures(const experiments::ExperimentResult& result);

}  // namespace touchdown::render
