#pragma once

#include <atomic>
#include <vector>

#include "experiments/results/result.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws the drops that the experiment's sections `detail` and `posterior` select, for every
/// engine. An engine without such a drop gets no figure, and one line on the error stream states
/// the reason; the experiment continues.
std::vector<Figure> draw_drop_figures(const experiments::ExperimentResult& result,
                                      const std::atomic<bool>* stop);

}  // namespace touchdown::render
