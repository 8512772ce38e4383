#pragma once

#include <filesystem>

#include "render/curves/latency_data.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws a latency figure. Files as `draw_figure`. Errors: `InputError` without rows; `Error` as
/// `draw_figure`.
Figure draw_latency_figure(const LatencyFigure& figure, const std::filesystem::path& stem);

}  // namespace touchdown::render
