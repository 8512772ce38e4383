#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/gnuplot/figure.hpp"

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
  std::optional<double> low = {};  ///< of the colour scale; else what the values need
};

/// Draws `<stem>.png`, `.svg`, `.pdf` with `<stem>.gp`, `<stem>.dat` and `style.gp` beside.
/// Errors: `InputError` when a panel's size is not y × x or nothing is there to draw; `Error` as
/// `draw_figure`.
Figure draw_heatmap(const Heatmap& heatmap, const std::filesystem::path& stem);

}  // namespace touchdown::render
