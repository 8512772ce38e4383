#include "render/figures/facet_layout.hpp"

#include <algorithm>

namespace touchdown::render {

namespace {

constexpr std::size_t most_columns = 4;
constexpr double title_height = 26.0, axis_height = 58.0, tics_height = 28.0, line_gap = 14.0;
constexpr double axis_width = 68.0, column_gap = 30.0, key_line = 17.0;
constexpr double narrowest = 600.0;  ///< the caption needs this width

/// Numbers of panels beside and below each other.
struct Grid {
  std::size_t columns = 1, lines = 1;
};

Grid grid_of(const FacetShape& shape) {
  if (shape.measures == 1) {
    const std::size_t lines = (shape.panels + most_columns - 1) / most_columns;
    return {(shape.panels + lines - 1) / lines, lines};
  }
  return shape.rows > 0 ? Grid{shape.measures, shape.panels} : Grid{shape.panels, shape.measures};
}

double panel_width(const Grid& grid) {
  return std::clamp(960.0 / static_cast<double>(grid.columns), 225.0, 330.0);
}

double panel_height(const FacetShape& shape, const Grid& grid) {
  if (shape.rows > 0) {
    const double row = std::max(27.0, 9.0 + 9.0 * static_cast<double>(shape.series));
    return row * static_cast<double>(shape.rows);
  }
  return (grid.lines == 1 ? 1.0 : 0.7) * panel_width(grid);
}

}  // namespace

FacetLayout facet_layout(const FacetShape& shape) {
  const Grid grid = grid_of(shape);
  const bool by_measure = shape.measures > 1;
  const double margin = shape.rows > 0 ? shape.row_names : axis_width;
  FacetLayout layout;
  layout.panel_width = panel_width(grid);
  layout.panel_height = panel_height(shape, grid);
  double top = 0.0;
  for (std::size_t line = 0; line < grid.lines; ++line) {
    const bool titled = shape.has_titles && (!by_measure || shape.rows > 0 || line == 0);
    const bool is_last = line + 1 == grid.lines;
    top += titled ? title_height : 4.0;
    bool any_x = false;
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const std::size_t place = line * grid.columns + column;
      FacetPanel panel;
      panel.panel = by_measure ? (shape.rows > 0 ? line : column) : place;
      panel.measure = by_measure ? (shape.rows > 0 ? column : line) : 0;
      if (panel.panel >= shape.panels) break;
      const bool is_lowest = is_last || (!by_measure && place + grid.columns >= shape.panels);
      panel.left = margin + static_cast<double>(column) * (layout.panel_width + column_gap);
      panel.top = top;
      panel.has_title = titled;
      panel.has_x_title = is_lowest;
      panel.has_x_tics = is_lowest || shape.rows > 0 || (shape.is_own_x && !by_measure);
      panel.is_leftmost = column == 0;
      any_x = any_x || panel.has_x_tics;
      layout.panels.push_back(panel);
    }
    top += layout.panel_height + (any_x ? (is_last ? axis_height : tics_height) : line_gap);
  }
  const double columns = static_cast<double>(grid.columns);
  layout.key_left = margin + columns * layout.panel_width + (columns - 1.0) * column_gap + 16.0;
  layout.key_top = layout.panels.front().top;
  layout.width = std::max(narrowest, layout.key_left + shape.key);
  layout.height =
      std::max(top, layout.key_top + key_line * static_cast<double>(shape.series) + axis_height);
  return layout;
}

}  // namespace touchdown::render
