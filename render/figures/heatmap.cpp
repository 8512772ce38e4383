#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/error.hpp"
#include "render/figures/figures.hpp"
#include "render/figures/iso_lines.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/palette.hpp"

namespace touchdown::render {
namespace {

constexpr const char* nothing = "NaN\tNaN\n\n";

std::string cell_text(const HeatmapPanel& panel, std::size_t row, std::size_t column) {
  std::string text = error_text(panel.value[row][column]);
  if (!panel.low.empty() && !panel.high.empty() && std::isfinite(panel.low[row][column])) {
    // In a data file, \n breaks a label's line.
    text += fmt::format("\\n{}–{}", error_text(panel.low[row][column]),
                        error_text(panel.high[row][column]));
  }
  return text;
}

std::string cells(const HeatmapPanel& panel) {
  std::string lines;
  for (std::size_t row = 0; row < panel.value.size(); ++row) {
    for (std::size_t column = 0; column < panel.value[row].size(); ++column) {
      const double value = panel.value[row][column];
      const std::string text = cell_text(panel, row, column);
      const bool crossed = !panel.marked.empty() && panel.marked[row][column];
      const MapColour colour =
          std::isfinite(value) ? error_colour(value) : MapColour{"#ffffff", true};
      fmt::format_to(std::back_inserter(lines), "{}\t{}\t{}\t\"{}\"\t{}\t{}\t{}\n", column, row,
                     number(value), text, colour.light ? 0x101418 : 0xffffff,
                     std::stoi(colour.hex.substr(1), {}, 16), crossed ? 1 : 0);
    }
  }
  return lines + '\n';
}

std::string lines(const std::vector<LevelBorder>& borders, const CellSize& cell) {
  std::string text;
  for (const LevelBorder& border : borders) {
    for (const IsoLine& part : without_label(border, cell)) {
      for (const auto& point : part) {
        fmt::format_to(std::back_inserter(text), "{}\t{}\n", point[0], point[1]);
      }
      text += '\n';
    }
  }
  return text.empty() ? nothing : text;
}

std::string line_labels(const std::vector<LevelBorder>& borders) {
  std::string text;
  for (const LevelBorder& border : borders) {
    if (!border.labelled) continue;
    const LabelPlace place = label_place(border);
    fmt::format_to(std::back_inserter(text), "{}\t{}\t\"{}\"\t{}\n", place.x, place.y,
                   label_of(border), place.upright ? 90 : 0);
  }
  return (text.empty() ? "NaN\tNaN\t\"\"\t0\n" : text) + '\n';
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

/// Kinds of blocks (gnuplot's `index`) of the data file; each kind has one block per panel.
enum Block : std::size_t { cell_block, line_block, label_block, cross_block };

/// A heatmap's data file. Its blocks, each for every panel: the cells (column, row, value, text,
/// the text's colour, the cell's colour, whether it is crossed), the lines, their labels (x, y,
/// text, degrees), the crosses.
std::string heatmap_data(const Heatmap& heatmap, const CellSize& cell) {
  std::string text = "#column\trow\terror_percent\tlabel\tlabel_colour\tcell_colour\tcrossed\n";
  std::string line_text, label_text, cross_text;
  for (const HeatmapPanel& panel : heatmap.panels) {
    const std::vector<LevelBorder> borders = level_borders(panel.value, heatmap.levels, cell);
    text += cells(panel) + '\n';
    line_text += lines(borders, cell) + '\n';
    label_text += line_labels(borders) + '\n';
    cross_text += crosses(panel) + '\n';
  }
  return text + line_text + label_text + cross_text;
}

constexpr double map_gap_x = 74.0, map_gap_y = 72.0,
                 scale_width = 104.0;  ///< between panels, for the scale (px)

/// Where panels are in the body of the frame (px). Their cells have the same size.
struct PanelLayout {
  CellSize cell;
  std::size_t columns, rows;  ///< of panels
  double panel_width, panel_height;
  double width, height;

  double left(std::size_t panel) const {
    return static_cast<double>(panel % columns) * (panel_width + map_gap_x) + map_gap_x - 8.0;
  }
  double top(std::size_t panel) const {
    const std::size_t row = panel / columns;
    return static_cast<double>(row) * (panel_height + map_gap_y) + 22.0;
  }
};

CellSize cell_size(const HeatmapShape& shape) {
  const bool has_numbers = shape.columns * shape.rows <= most_numbered_cells;
  if (has_numbers && shape.has_intervals) return {92.0, 54.0};
  if (has_numbers) return {60.0, 44.0};
  const double width = std::max(26.0, 350.0 / static_cast<double>(shape.columns));
  return {width, std::max(22.0, 0.82 * width)};
}

PanelLayout layout_of(const HeatmapShape& shape) {
  PanelLayout layout{};
  layout.cell = cell_size(shape);
  layout.columns = std::min<std::size_t>(shape.panels, shape.panels == 4 ? 2 : 3);
  layout.rows = (shape.panels + layout.columns - 1) / layout.columns;
  layout.panel_width = layout.cell.width * static_cast<double>(shape.columns);
  layout.panel_height = layout.cell.height * static_cast<double>(shape.rows);
  layout.width = std::max(
      560.0, static_cast<double>(layout.columns) * (layout.panel_width + map_gap_x) + scale_width);
  layout.height = static_cast<double>(layout.rows) * (layout.panel_height + map_gap_y);
  return layout;
}

/// As many of an axis's values as fit: every one, every second, ... `space` is per value (px).
std::string tics(const std::vector<double>& values, double space) {
  constexpr double letter = 8.0;
  std::size_t longest = 1;
  for (const double value : values)
    longest = std::max(longest, fmt::format("{:.4g}", value).size());
  const auto every =
      static_cast<std::size_t>(std::ceil(letter * (static_cast<double>(longest) + 0.5) / space));
  std::string text;
  for (std::size_t i = 0; i < values.size(); i += std::max<std::size_t>(every, 1)) {
    text += fmt::format("{}'{:.4g}' {}", i == 0 ? "" : ", ", values[i], i);
  }
  return "(" + text + ")";
}

/// The cells' numbers. A cross is interrupted behind a number, where its lines would look like
/// dots.
std::string numbers_plot(std::size_t block, bool with_intervals, const CellSize& cell) {
  return fmt::format(
      ", \\\n     '' index {0} using ($7 > 0 ? $1 : NaN):2:($1-{1:.4f}):($1+{1:.4f}):"
      "($2-{2:.4f}):($2+{2:.4f}):6 with boxxyerror linecolor rgb variable fillstyle solid noborder"
      ", \\\n     '' index {0} using 1:2:4:5 with labels font ',8.5' textcolor rgb variable",
      block, (with_intervals ? 32.0 : 17.0) / cell.width,
      (with_intervals ? 15.0 : 8.0) / cell.height);
}

/// The lines' labels, with a white outline that makes them legible on every colour.
std::string line_labels_plot(std::size_t block, const CellSize& cell) {
  constexpr double reach = 1.6;  // pixels
  constexpr const char* with = "with labels rotate variable font ',8' textcolor rgb";
  std::string text;
  for (int turn = 0; turn < 8; ++turn) {
    text += fmt::format(", \\\n     '' index {} using ($1+({:.4f})):($2+({:.4f})):3:4 {} '#ffffff'",
                        block, reach * std::cos(turn * M_PI / 4) / cell.width,
                        reach * std::sin(turn * M_PI / 4) / cell.height, with);
  }
  return text + fmt::format(", \\\n     '' index {} using 1:2:3:4 {} '#101418'", block, with);
}

/// The commands that draw panel `i` from the blocks of `<name>.dat` (`heatmap_data`): cells,
/// crosses, numbers, lines and labels.
std::string panel_plot(const Heatmap& heatmap, const std::string& name, std::size_t i, bool numbers,
                       const CellSize& cell) {
  const auto block = [&](Block kind) { return heatmap.panels.size() * kind + i; };
  std::string text = fmt::format(
      "plot '{}.dat' index {} using 1:2:($1-0.5):($1+0.5):($2-0.5):($2+0.5):(shown($3)) with "
      "boxxyerror fillcolor palette, \\\n"
      "     '' index {} using 1:2 with lines lw 0.7 lc rgb '#aab0b8' dt 1",
      name, block(cell_block), block(cross_block));
  if (numbers) {
    text += numbers_plot(block(cell_block), !heatmap.panels[i].low.empty(), cell);
  }
  text += fmt::format(
      ", \\\n     '' index {0} using 1:2 with lines lw 3.4 lc rgb '#ffffff' dt 1"
      ", \\\n     '' index {0} using 1:2 with lines lw 1.5 lc rgb '#101418' dt 1",
      block(line_block));
  return text + line_labels_plot(block(label_block), cell) + '\n';
}

/// gnuplot's palette and ticks for error rates.
std::string colour_scale(const Heatmap& heatmap) {
  std::string stops, ticks;
  for (std::size_t i = 0; i < viridis.size(); ++i) {
    stops += fmt::format("{}{} '#{:06x}'", i == 0 ? "" : ", ", i, viridis[viridis.size() - 1 - i]);
  }
  for (const double level : heatmap.levels) ticks += fmt::format("'{0}' {0}, ", level);
  return fmt::format(
      "set palette defined ({2})\nset logscale cb\nset cbrange [{0}:{1}]\n"
      "set cbtics ({3}'≤ {0}' {0}, '≥ {1}' {1})\n"
      "shown(error) = error < {0} ? {0} : error > {1} ? {1} : error\n",
      lowest_error, highest_error, stops, ticks);
}

/// The alternative text: each panel's first and last cell.
std::string described(const Heatmap& heatmap) {
  std::string text = fmt::format("Maps of the error rate by {} (across) and {} (up).",
                                 heatmap.x_label, heatmap.y_label);
  for (const HeatmapPanel& panel : heatmap.panels) {
    text +=
        fmt::format(" {}: {} % in the lower left cell, {} % in the upper right one.", panel.title,
                    error_text(panel.value.front().front()), error_text(panel.value.back().back()));
  }
  return text;
}

}  // namespace

Figure draw_heatmap(const Heatmap& heatmap, const std::filesystem::path& stem) {
  if (heatmap.panels.empty() || heatmap.x.empty() || heatmap.y.empty()) {
    throw InputError("a heatmap without cells");
  }
  const bool numbers = heatmap.x.size() * heatmap.y.size() <= most_numbered_cells;
  const PanelLayout layout = layout_of({heatmap.panels.size(), heatmap.x.size(), heatmap.y.size(),
                                        !heatmap.panels.front().low.empty(), heatmap.caption});
  const CellSize& cell = layout.cell;
  const FigureFrame frame(heatmap.title, heatmap.caption, layout.width, layout.height);
  const std::string name = stem.filename().string();
  std::string commands = fmt::format(
      "unset grid\nset border 0\nset tics scale 0\n"
      "{}set xrange [-0.5:{}]\nset yrange [-0.5:{}]\n"
      "set xtics {}\nset ytics {}\nunset key\n",
      colour_scale(heatmap), static_cast<double>(heatmap.x.size()) - 0.5,
      static_cast<double>(heatmap.y.size()) - 0.5, tics(heatmap.x, cell.width),
      tics(heatmap.y, 2.0 * cell.height));
  for (std::size_t i = 0; i < heatmap.panels.size(); ++i) {
    commands += frame.panel(layout.left(i), layout.top(i), layout.panel_width, layout.panel_height);
    commands += fmt::format(
        "set title {} offset 0,-0.6\nset xlabel {} offset 0,0.4\nset ylabel {} offset 0.6,0\n",
        gnuplot_text(heatmap.panels[i].title), gnuplot_text(heatmap.x_label),
        gnuplot_text(i % layout.columns == 0 ? heatmap.y_label : ""));
    commands += i == 0 ? frame.colour_bar(layout.width - scale_width + 16.0, layout.top(0), 14.0,
                                          layout.panel_height) +
                             "set cblabel 'error rate (%), lower is better' offset 0.4,0\n"
                       : "unset colorbox\n";
    commands += panel_plot(heatmap, name, i, numbers, cell) + FigureFrame::end_panel();
  }
  return frame.draw(stem, commands, heatmap_data(heatmap, cell), described(heatmap));
}

HeatmapPlaces heatmap_places(const HeatmapShape& shape) {
  const PanelLayout layout = layout_of(shape);
  const FigureFrame frame({}, shape.caption, layout.width, layout.height);
  HeatmapPlaces places{frame.width(), frame.height(), {}};
  for (std::size_t i = 0; i < shape.panels; ++i) {
    const double left = frame.x(layout.left(i)), upper = frame.y(layout.top(i));
    places.panels.push_back({left, 1.0 - upper, frame.x(layout.left(i) + layout.panel_width) - left,
                             upper - frame.y(layout.top(i) + layout.panel_height)});
  }
  return places;
}

}  // namespace touchdown::render
