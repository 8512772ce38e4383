#include "render/maps/heatmap_figure.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/error.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/gnuplot/text.hpp"
#include "render/maps/iso_lines.hpp"
#include "render/maps/map_colour.hpp"

namespace touchdown::render {
namespace {

/// More cells than this are too many to write a number into each.
constexpr std::size_t most_numbers = 64;

void check(const Heatmap& heatmap) {
  if (heatmap.panels.empty() || heatmap.x.empty() || heatmap.y.empty()) {
    throw InputError("a heatmap without cells");
  }
  for (const HeatmapPanel& panel : heatmap.panels) {
    if (!panel.marked.empty() && panel.marked.size() != heatmap.y.size()) {
      throw InputError(
          fmt::format("heatmap '{}': expected {} rows of marks", panel.title, heatmap.y.size()));
    }
    for (const auto* matrix : {&panel.value, &panel.low, &panel.high}) {
      const bool optional = matrix != &panel.value && matrix->empty();
      const bool fits = matrix->size() == heatmap.y.size() &&
                        std::all_of(matrix->begin(), matrix->end(), [&](const auto& row) {
                          return row.size() == heatmap.x.size();
                        });
      if (!optional && !fits) {
        throw InputError(fmt::format("heatmap '{}': expected {} rows of {} values", panel.title,
                                     heatmap.y.size(), heatmap.x.size()));
      }
    }
  }
}

/// Ends of a heatmap's colour scale.
struct ColourRange {
  double low, high;
};
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
  low = heatmap.low.value_or(low);
  if (!std::isfinite(low)) low = 0.0;
  if (!std::isfinite(high)) high = 1.0;
  if (high - low < 1e-3) low = high - 1e-3;
  return {low, high};
}

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

/// A heatmap's data file. Its blocks (gnuplot's `index`), each for every panel: the cells (column,
/// row, value, text, the text's colour, the cell's colour), the lines of the first level, of the
/// second and so on, and the crosses.
std::string heatmap_data(const Heatmap& heatmap, const ColourRange& range) {
  std::string text = "#column\trow\tvalue\tlabel\tlabel_colour\tcell_colour\n";
  for (const HeatmapPanel& panel : heatmap.panels) text += cells(panel, range) + '\n';
  for (const double level : heatmap.iso_levels) {
    for (const HeatmapPanel& panel : heatmap.panels) text += lines(panel, level) + '\n';
  }
  for (const HeatmapPanel& panel : heatmap.panels) text += crosses(panel) + '\n';
  return text;
}

/// Cells of all panels have the same size (px).
struct CellSize {
  double width, height;
};

CellSize cell_size(const Heatmap& heatmap, bool numbers) {
  if (numbers && !heatmap.panels.front().low.empty()) return {92.0, 54.0};
  if (numbers) return {60.0, 44.0};
  const double width = std::max(26.0, 350.0 / static_cast<double>(heatmap.x.size()));
  return {width, std::max(22.0, 0.82 * width)};
}

/// As many of an axis's values as have room: every one, every second, ...
std::string tics(const std::vector<double>& values, double room) {
  constexpr double letter = 8.0;
  std::size_t longest = 1;
  for (const double value : values)
    longest = std::max(longest, fmt::format("{:.4g}", value).size());
  const auto every =
      static_cast<std::size_t>(std::ceil(letter * (static_cast<double>(longest) + 0.5) / room));
  std::string text;
  for (std::size_t i = 0; i < values.size(); i += std::max<std::size_t>(every, 1)) {
    text += fmt::format("{}'{:.4g}' {}", i == 0 ? "" : ", ", values[i], i);
  }
  return "(" + text + ")";
}

constexpr const char* dashes[] = {"1", "(14,5)", "(4,4)"};

/// The dashes (gnuplot's `dt`) of the iso-lines, by level: solid, dashed, dotted.
const char* line_dash(std::size_t level) { return dashes[std::min(level, std::size(dashes) - 1)]; }

/// The commands that draw panel `i` from the blocks of `<name>.dat` (`heatmap_data`): cells,
/// crosses and lines, then numbers. A number is written first around its place in its cell's
/// colour, so that lines disappear behind it.
std::string panel_plot(const Heatmap& heatmap, const std::string& name, std::size_t i, bool numbers,
                       const CellSize& cell) {
  const std::size_t panels = heatmap.panels.size(), levels = heatmap.iso_levels.size();
  std::string text = fmt::format(
      "plot '{}.dat' index {} using 1:2:($1-0.5):($1+0.5):($2-0.5):($2+0.5):3 with boxxyerror "
      "fillcolor palette, \\\n     '' index {} using 1:2 with lines lw 0.7 lc rgb '#aab0b8' dt 1",
      name, i, panels * (1 + levels) + i);
  for (std::size_t level = 0; level < levels; ++level) {
    const std::size_t index = panels * (1 + level) + i;
    text += fmt::format(
        ", \\\n     '' index {0} using 1:2 with lines lw 3.6 lc rgb '#ffffff' dt 1"
        ", \\\n     '' index {0} using 1:2 with lines lw 1.5 lc rgb '#101418' dt {1}",
        index, line_dash(level));
  }
  if (numbers) {
    constexpr double reach = 1.6;  // pixels
    for (int turn = 0; turn < 8; ++turn) {
      text += fmt::format(
          ", \\\n     '' index {} using ($1+({:.4f})):($2+({:.4f})):4:6 with labels font ',8.5' "
          "textcolor rgb variable",
          i, reach * std::cos(turn * M_PI / 4) / cell.width,
          reach * std::sin(turn * M_PI / 4) / cell.height);
    }
    text += fmt::format(
        ", \\\n     '' index {} using 1:2:4:5 with labels font ',8.5' textcolor rgb variable", i);
  }
  return text + '\n';
}

/// What the lines are, in the upper right corner: a panel of its own, because a key that is wider
/// than its panel is broken into rows.
std::string line_key(const Heatmap& heatmap, const FigureFrame& frame) {
  if (heatmap.iso_levels.empty()) return {};
  std::string commands = frame.panel(0.0, -32.0, frame.width(), 24.0) +
                         fmt::format(
                             "unset title\nunset xlabel\nunset ylabel\nunset xtics\nunset ytics\n"
                             "set key at screen 0.985, screen {} right top horizontal samplen 4\n"
                             "plot [0:1] [0:1] ",
                             1.0 - 8.0 / frame.height());
  for (std::size_t level = 0; level < heatmap.iso_levels.size(); ++level) {
    commands += fmt::format(
        "{}NaN with lines lw 1.5 lc rgb '#101418' dt {} title {}", level > 0 ? ", " : "",
        line_dash(level),
        gnuplot_text(fmt::format("{}{:.4g}", level == 0 ? heatmap.value_label + " " : "",
                                 heatmap.iso_levels[level])));
  }
  return commands + '\n';
}

/// Each panel's first and last cell, for people who cannot see it.
std::string described(const Heatmap& heatmap) {
  std::string text = fmt::format("Maps of {} by {} (across) and {} (up).", heatmap.value_label,
                                 heatmap.x_label, heatmap.y_label);
  for (const HeatmapPanel& panel : heatmap.panels) {
    text += fmt::format(" {}: {:.3f} in the lower left cell, {:.3f} in the upper right one.",
                        panel.title, panel.value.front().front(), panel.value.back().back());
  }
  return text;
}

}  // namespace

Figure draw_heatmap(const Heatmap& heatmap, const std::filesystem::path& stem) {
  check(heatmap);
  const ColourRange range = colour_range(heatmap);
  const std::size_t panels = heatmap.panels.size();
  const std::size_t columns = std::min<std::size_t>(panels, panels == 4 ? 2 : 3);
  const std::size_t rows = (panels + columns - 1) / columns;
  const bool numbers = heatmap.x.size() * heatmap.y.size() <= most_numbers;
  const CellSize cell = cell_size(heatmap, numbers);
  const double panel_width = cell.width * static_cast<double>(heatmap.x.size());
  const double panel_height = cell.height * static_cast<double>(heatmap.y.size());
  const double gap_x = 74.0, gap_y = 72.0, bar = 92.0;
  const double width = std::max(560.0, static_cast<double>(columns) * (panel_width + gap_x) + bar);
  const FigureFrame frame(heatmap.title, heatmap.caption, width,
                          static_cast<double>(rows) * (panel_height + gap_y));

  const std::string name = stem.filename().string();
  std::string commands = fmt::format(
      "unset grid\nset border 0\nset tics scale 0\n"
      "set cbrange [{}:{}]\nset xrange [-0.5:{}]\nset yrange [-0.5:{}]\n"
      "set xtics {}\nset ytics {}\nunset key\n",
      range.low, range.high, static_cast<double>(heatmap.x.size()) - 0.5,
      static_cast<double>(heatmap.y.size()) - 0.5, tics(heatmap.x, cell.width),
      tics(heatmap.y, 2.0 * cell.height));
  for (std::size_t i = 0; i < panels; ++i) {
    const double left = static_cast<double>(i % columns) * (panel_width + gap_x) + gap_x - 8.0;
    const std::size_t row = i / columns;
    const double top = static_cast<double>(row) * (panel_height + gap_y) + 22.0;
    commands += frame.panel(left, top, panel_width, panel_height);
    commands += fmt::format(
        "set title {} offset 0,-0.6\nset xlabel {} offset 0,0.4\nset ylabel {} offset 0.6,0\n",
        gnuplot_text(heatmap.panels[i].title), gnuplot_text(heatmap.x_label),
        gnuplot_text(i % columns == 0 ? heatmap.y_label : ""));
    commands += i == 0 ? frame.colour_bar(width - bar + 16.0, top, 14.0, panel_height) +
                             fmt::format("set cblabel {} offset 0.4,0\nset cbtics format '%.3g'\n",
                                         gnuplot_text(heatmap.value_label))
                       : "unset colorbox\n";
    commands += panel_plot(heatmap, name, i, numbers, cell) + FigureFrame::end_panel();
  }
  return frame.draw(stem, commands + line_key(heatmap, frame), heatmap_data(heatmap, range),
                    described(heatmap));
}

}  // namespace touchdown::render
