#include "render/report/map.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/maps/iso_lines.hpp"
#include "render/maps/map_colour.hpp"
#include "render/report/html.hpp"

namespace touchdown::render {
namespace {

constexpr int cell_width = 54, cell_height = 40, left = 58, top = 4, bottom = 46;

std::string iso_path(const ReportMap& map, double level) {
  std::vector<std::vector<double>> values;
  for (const auto& row : map.cells) {
    values.emplace_back();
    for (const MapCell& cell : row) values.back().push_back(cell.value);
  }
  const auto x = [](double column) { return left + (column + 0.5) * cell_width; };
  const auto y = [&](double row) {
    return top + (static_cast<double>(map.y.size()) - row - 0.5) * cell_height;
  };
  std::string path;
  for (const IsoPiece& piece : iso_lines(values, level)) {
    path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", x(piece[0][0]), y(piece[0][1]),
                        x(piece[1][0]), y(piece[1][1]));
  }
  return path;
}

MapColour cell_colour(const ReportMap& map, const MapCell& cell) {
  if (!std::isfinite(cell.value)) return {"#595959", false};
  return map_colour((cell.value - map.low) / (map.high - map.low));
}

/// A cell's number, with a seam of the cell's colour that lines disappear behind.
std::string number_svg(const ReportMap& map, const MapCell& cell, int x, int y) {
  const bool known = std::isfinite(cell.value);
  const MapColour colour = cell_colour(map, cell);
  return fmt::format("<text class=\"number {}\" x=\"{}\" y=\"{}\" stroke=\"{}\">{}</text>\n",
                     colour.light ? "on-light" : "on-dark", x + cell_width / 2,
                     y + cell_height / 2 + 4, colour.hex,
                     known ? fmt::format("{:.3f}", cell.value) : std::string("–"));
}

std::string cell_svg(const ReportMap& map, const MapCell& cell, int x, int y) {
  const MapColour colour = cell_colour(map, cell);
  std::string svg = fmt::format(
      "<g class=\"cell\" data-say=\"{0}\"><title>{0}</title><rect x=\"{1}\" y=\"{2}\" "
      "width=\"{3}\" height=\"{4}\" fill=\"{5}\"/>",
      escaped(cell.says), x, y, cell_width, cell_height, colour.hex);
  if (cell.value <= cell.to_beat) {
    svg += fmt::format("<path class=\"beaten\" d=\"M{} {}l{} {}\"/>", x + 3, y + cell_height - 3,
                       cell_width - 6, 6 - cell_height);
  }
  svg += "</g>\n";
  return svg;
}

}  // namespace

std::string map_svg(const ReportMap& map) {
  const int columns = static_cast<int>(map.x.size()), rows = static_cast<int>(map.y.size());
  const int width = left + columns * cell_width + 2;
  const int height = top + rows * cell_height + bottom;
  std::string svg = fmt::format(
      "<div class=\"pan\"><svg class=\"map\" viewBox=\"0 0 {} {}\" data-columns=\"{}\" "
      "tabindex=\"0\" role=\"group\" "
      "aria-label=\"{}. Rows: {}; columns: {}. The arrow keys choose a cell.\">\n",
      width, height, columns, escaped(map.title), escaped(map.y_label), escaped(map.x_label));
  for (int r = 0; r < rows; ++r) {
    const int y = top + (rows - 1 - r) * cell_height;
    for (int c = 0; c < columns; ++c) {
      svg += cell_svg(map, map.cells[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)],
                      left + c * cell_width, y);
    }
    svg += fmt::format("<text class=\"tick\" x=\"{}\" y=\"{}\">{:.4g}</text>\n", left - 16,
                       y + cell_height / 2 + 4, map.y[static_cast<std::size_t>(r)]);
  }
  for (int c = 0; c < columns; ++c) {
    svg += fmt::format("<text class=\"tick\" x=\"{}\" y=\"{}\">{:.4g}</text>\n",
                       left + c * cell_width + cell_width / 2, top + rows * cell_height + 16,
                       map.x[static_cast<std::size_t>(c)]);
  }
  for (const double level : map.iso_levels) {
    const std::string path = iso_path(map, level);
    if (path.empty()) continue;
    svg +=
        fmt::format("<path class=\"iso-halo\" d=\"{0}\"/><path class=\"iso\" d=\"{0}\"/>\n", path);
  }
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      svg += number_svg(map, map.cells[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)],
                        left + c * cell_width, top + (rows - 1 - r) * cell_height);
    }
  }
  svg += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", left + columns * cell_width / 2,
                     height - 8, escaped(map.x_label));
  svg += fmt::format("<text transform=\"translate(14 {}) rotate(-90)\">{}</text>\n</svg></div>\n",
                     top + rows * cell_height / 2, escaped(map.y_label));
  return svg;
}

}  // namespace touchdown::render
