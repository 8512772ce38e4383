#pragma once

#include <filesystem>

#include "render/gnuplot/figure.hpp"
#include "render/maps/density_data.hpp"

namespace touchdown::render {

/// Draws a density figure. Files as `draw_figure`. Errors: `InputError` without rows; `Error` as
/// `draw_figure`.
Figure draw_density_figure(const DensityFigure& figure, const std::filesystem::path& stem);

}  // namespace touchdown::render
