#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace touchdown::render {

/// The points of a line in grid coordinates (column, row); a closed line ends where it begins.
using BorderLine = std::vector<std::array<double, 2>>;

/// A line along the edges of a map's cells, with smaller values on one side and larger ones on the
/// other. It never enters a cell, where the numbers are. Cell (column, row) extends half a unit
/// around these coordinates.
struct LevelBorder {
  std::vector<double> levels;  ///< all between the values of its two sides, ascending
  BorderLine line;             ///< from corner to corner
  /// The label with the levels is on the middle of the segment from `line[i]` to `line[i + 1]`.
  /// There is no label where the labels of longer lines leave no space.
  std::optional<std::size_t> labelled = {};
};

/// The size of a map's cells (px).
struct CellSize {
  double width, height;
};

/// The borders of these levels, longest first; each segment of an edge belongs to one border. A
/// value equal to a level counts as above it. No border runs beside NaN.
std::vector<LevelBorder> level_borders(const std::vector<std::vector<double>>& rows,
                                       const std::vector<double>& levels, const CellSize& cell);

/// The success rates between its sides: "98 %", "95–98 %" from the first to the last of several.
std::string label_of(const LevelBorder& border);

/// The position of a label, and whether it follows a vertical edge.
struct LabelPlace {
  double x, y;
  bool upright;
};
LabelPlace label_place(const LevelBorder& border);

/// The line with a gap for its label, in letters of 10 px.
std::vector<BorderLine> without_label(const LevelBorder& border, const CellSize& cell);

}  // namespace touchdown::render
