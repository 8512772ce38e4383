#pragma once

#include <cstddef>
#include <string>

#include "render/heatmap.hpp"

namespace touchdown {

/// Cells of all panels have the same size in pixels.
struct CellSize {
  double width, height;
};

/// The dashes (gnuplot's `dt`) of the iso-lines, by level: solid, dashed, dotted.
const char* line_dash(std::size_t level);

/// The commands that draw panel `i` from the blocks of `<name>.dat` (`heatmap_data`): cells,
/// crosses and lines, then numbers. A number is written first around its place in its cell's
/// colour, so that lines disappear behind it. The first panel names the lines in the key.
std::string heatmap_plot(const Heatmap& heatmap, const std::string& name, std::size_t i,
                         bool numbers, const CellSize& cell);

}  // namespace touchdown
