#pragma once

#include <filesystem>

#include "render/curves/reliability.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws reliability curves. Files as `draw_figure`. Errors: `InputError` without curves; `Error`
/// as `draw_figure`.
Figure draw_reliability_figure(const ReliabilityFigure& figure, const std::filesystem::path& stem);

}  // namespace touchdown::render
