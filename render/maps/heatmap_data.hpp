#pragma once

#include <string>

#include "render/maps/heatmap.hpp"

namespace touchdown::render {

/// Ends of a heatmap's colour scale: those that it asks for, or what its values need.
struct ColourRange {
  double low, high;
};
ColourRange colour_range(const Heatmap& heatmap);

/// A heatmap's data file. Its blocks (gnuplot's `index`), each for every panel: the cells (column,
/// row, value, text, the text's colour, the cell's colour), the lines of the first level, of the
/// second and so on, and the crosses.
std::string heatmap_data(const Heatmap& heatmap, const ColourRange& range);

}  // namespace touchdown::render
