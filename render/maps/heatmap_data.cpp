#include "render/maps/heatmap_data.hpp"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "render/gnuplot/text.hpp"
#include "render/maps/iso_lines.hpp"
#include "render/maps/map_colour.hpp"

namespace touchdown::render {
namespace {

constexpr const char* nothing = "NaN\tNaN\n\n";

std::string cell_text(const HeatmapPanel& panel, std::size_t row, std::size_t column) {
  const double value = panel.value[row][column];
  if (!std::isfinite(value)) return "–";
  std::string text = fmt::format("{:.3f}", value);
  if (!panel.low.empty() && !panel.high.empty() && std::isfinite(panel.low[row][column])) {
    // In a data file, \n breaks a label's line.
    text += fmt::format("\\n{:.3f}–{:.3f}", panel.low[row][column], panel.high[row][column]);
  }
  return text;
}

std::string cells(const HeatmapPanel& panel, const ColourRange& range) {
  std::string text;
  for (std::size_t row = 0; row < panel.value.size(); ++row) {
    for (std::size_t column = 0; column < panel.value[row].size(); ++column) {
      const double value = panel.value[row][column];
      const MapColour colour = std::isfinite(value)
                                   ? map_colour((value - range.low) / (range.high - range.low))
                                   : MapColour{"#ffffff", true};
      fmt::format_to(std::back_inserter(text), "{}\t{}\t{}\t\"{}\"\t{}\t{}\n", column, row,
                     number(value), cell_text(panel, row, column),
                     colour.light ? 0x101418 : 0xffffff, std::stoi(colour.hex.substr(1), {}, 16));
    }
  }
  return text + '\n';
}

std::string lines(const HeatmapPanel& panel, double level) {
  std::string text;
  for (const IsoLine& line : joined(iso_lines(panel.value, level))) {
    for (const auto& point : line) {
      fmt::format_to(std::back_inserter(text), "{}\t{}\t{}\n", point[0], point[1], level);
    }
    text += '\n';
  }
  return text.empty() ? nothing : text;
}

/// Both diagonals of every marked cell.
std::string crosses(const HeatmapPanel& panel) {
  std::string text;
  for (std::size_t row = 0; row < panel.marked.size(); ++row) {
    for (std::size_t column = 0; column < panel.marked[row].size(); ++column) {
      if (!panel.marked[row][column]) continue;
      const auto x = static_cast<double>(column), y = static_cast<double>(row);
      for (const double slope : {0.5, -0.5}) {
        fmt::format_to(std::back_inserter(text), "{}\t{}\n{}\t{}\n\n", x - 0.5, y - slope, x + 0.5,
                       y + slope);
      }
    }
  }
  return text.empty() ? nothing : text;
}

}  // namespace

ColourRange colour_range(const Heatmap& heatmap) {
  double low = NAN, high = NAN;
  for (const HeatmapPanel& panel : heatmap.panels) {
    for (const auto& row : panel.value) {
      for (const double value : row) {
        if (!std::isfinite(value)) continue;
        low = std::fmin(low, value);
        high = std::fmax(high, value);
      }
    }
  }
  if (std::isfinite(heatmap.low)) low = heatmap.low;
  if (std::isfinite(heatmap.high)) high = heatmap.high;
  if (!std::isfinite(low)) low = 0.0;
  if (!std::isfinite(high)) high = 1.0;
  if (high - low < 1e-3) low = high - 1e-3;
  return {low, high};
}

std::string heatmap_data(const Heatmap& heatmap, const ColourRange& range) {
  std::string text = "#column\trow\tvalue\tlabel\tlabel_colour\tcell_colour\n";
  for (const HeatmapPanel& panel : heatmap.panels) text += cells(panel, range) + '\n';
  for (const double level : heatmap.iso_levels) {
    for (const HeatmapPanel& panel : heatmap.panels) text += lines(panel, level) + '\n';
  }
  for (const HeatmapPanel& panel : heatmap.panels) text += crosses(panel) + '\n';
  return text;
}

}  // namespace touchdown::render
