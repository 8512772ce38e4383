#pragma once

#include <vector>

#include "experiments/results/result.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws the drops that the experiment's sections `detail` and `posterior` ask for, for every
/// engine. An engine whose run has no such drop gets no figure and one line on the error stream
/// that says why: the experiment is not lost for it.
std::vector<Figure> draw_drop_figures(const experiments::ExperimentResult& result);

}  // namespace touchdown::render
