#pragma once

#include <atomic>
#include <vector>

#include "experiments/results/result.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws into the run directory, for every engine: the measurement models that were fitted to its
/// runs, evidence curves, and reliability diagrams and latencies at the highlighted noise settings,
/// both wheels pooled. Figures without data are left out.
std::vector<Figure> draw_score_figures(const experiments::ExperimentResult& result,
                                       const std::atomic<bool>* stop);

}  // namespace touchdown::render
