#pragma once

#include <limits>
#include <string>
#include <vector>

namespace touchdown::render {

/// One map: `value[row][column]` for the figure's y[row] and x[column]; NaN where unknown. `low`
/// and `high`, the ends of each cell's interval, may be empty, and so may `marked`, the cells that
/// are crossed.
struct HeatmapPanel {
  std::string title;
  std::vector<std::vector<double>> value;
  std::vector<std::vector<double>> low = {}, high = {};
  std::vector<std::vector<bool>> marked = {};
};

/// Maps over the same two quantities, side by side, with one colour scale. Every cell of up to 64
/// says its number, and its interval where there is one; finer maps leave the numbers to the data
/// file.
struct Heatmap {
  std::string title;
  std::string x_label, y_label, value_label;  ///< with units
  std::vector<double> x, y;
  std::vector<HeatmapPanel> panels;
  std::string caption;             ///< runs, seeds, what counts as contact
  std::vector<double> iso_levels;  ///< lines of equal value
  /// Ends of the colour scale; NaN: what the values need.
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace touchdown::render
