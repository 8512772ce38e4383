#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/maps/iso_lines.hpp"

namespace touchdown::render {

/// A line along the edges of a map's cells with smaller values on one side and larger ones on the
/// other: it never enters a cell, where the numbers are. Cell (column, row) reaches half a unit
/// around its place.
struct LevelBorder {
  std::vector<double> levels;  ///< all that lie between its two sides, ascending
  IsoLine line;                ///< from corner to corner
  /// The piece, `line[i]` to `line[i + 1]`, whose middle says the levels; none where the labels of
  /// longer lines leave no room.
  std::optional<std::size_t> labelled = {};
};

/// Of a map's cells (px).
struct CellSize {
  double width, height;
};

/// The borders of these levels, every piece of edge in one of them, longest first. A value that is
/// a level counts as above it; no border runs beside NaN.
std::vector<LevelBorder> level_borders(const std::vector<std::vector<double>>& rows,
                                       const std::vector<double>& levels, const CellSize& cell);

/// "2 %"; "2, 5 %".
std::string label_of(const LevelBorder& border);

/// Where the label stands, and whether along an edge that goes up.
struct LabelPlace {
  double x, y;
  bool upright;
};
LabelPlace label_place(const LevelBorder& border);

/// The line without the room that its label needs, written in letters of 10 px.
std::vector<IsoLine> without_label(const LevelBorder& border, const CellSize& cell);

}  // namespace touchdown::render
