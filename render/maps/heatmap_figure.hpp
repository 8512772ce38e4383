#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/gnuplot/figure.hpp"
#include "render/maps/error_scale.hpp"

namespace touchdown::render {

/// One map of error rates (%): `value[row][column]` for the figure's y[row] and x[column]; NaN
/// where unknown. `low` and `high` are the ends of each cell's interval; `marked` cells are
/// crossed. All three may be empty.
struct HeatmapPanel {
  std::string title;
  std::vector<std::vector<double>> value;
  std::vector<std::vector<double>> low = {}, high = {};
  std::vector<std::vector<bool>> marked = {};
};

/// Maps over the same two quantities, side by side, on the common colour scale of error rates. Maps
/// of up to 64 cells show each cell's number, and its interval where there is one. For finer maps
/// only the data file contains the numbers.
struct Heatmap {
  std::string title;
  std::string x_label, y_label;  ///< with units
  std::vector<double> x, y;
  std::vector<HeatmapPanel> panels;
  std::string caption;  ///< the runs, the seeds, and what counts as contact
  /// Lines between cells below and above (%).
  std::vector<double> levels = {error_levels.begin(), error_levels.end()};
};

/// Maps with more cells than this show no numbers.
inline constexpr std::size_t most_numbered_cells = 64;

/// Draws `<stem>.png`, `.svg`, `.pdf` with `<stem>.gp` and `<stem>.dat` beside.
/// Errors: `InputError` when a panel's size is not y × x or there is nothing to draw; `Error` as
/// `draw_figure`.
Figure draw_heatmap(const Heatmap& heatmap, const std::filesystem::path& stem);

}  // namespace touchdown::render
