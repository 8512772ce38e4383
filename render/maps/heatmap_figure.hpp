#pragma once

#include <filesystem>

#include "render/gnuplot/figure.hpp"
#include "render/maps/heatmap.hpp"

namespace touchdown::render {

/// Draws `<stem>.png`, `.svg`, `.pdf` with `<stem>.gp`, `<stem>.dat` and `style.gp` beside.
/// Errors: `InputError` when a panel's size is not y × x or nothing is there to draw; `Error` as
/// `draw_figure`.
Figure draw_heatmap(const Heatmap& heatmap, const std::filesystem::path& stem);

}  // namespace touchdown::render
