#pragma once

#include <string>
#include <vector>

namespace touchdown::render {

/// A cell of a map in the report: its colour's value and what it says when it is pointed at.
struct MapCell {
  double value;
  double to_beat;  ///< crossed out when the value is no better; NaN: never
  std::string says;
};

/// A map over two quantities as inline SVG whose cells say their numbers.
struct ReportMap {
  std::string title;
  std::string x_label, y_label;
  std::vector<double> x, y;                 ///< columns from the left, rows from the bottom
  std::vector<std::vector<MapCell>> cells;  ///< by row, then column
  double low = 0.0, high = 1.0;             ///< of the colours
  std::vector<double> iso_levels;
};

std::string map_svg(const ReportMap& map);

}  // namespace touchdown::render
