#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/error.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/palette.hpp"

namespace touchdown::render {
namespace {

constexpr const char* nothing = "NaN\tNaN\n\n";

std::string cell_text(const HeatmapPanel& panel, std::size_t row, std::size_t column,
                      bool has_interval) {
  std::string text = success_text(panel.value[row][column]);
  if (has_interval && std::isfinite(panel.low[row][column])) {
    // In a data file, \n breaks a label's line.
    text += fmt::format("\\n{}–{}", success_text(panel.high[row][column]),
                        success_text(panel.low[row][column]));
  }
  return text;
}

std::string cells(const HeatmapPanel& panel, bool has_intervals) {
  std::string lines;
  for (std::size_t row = 0; row < panel.value.size(); ++row) {
    for (std::size_t column = 0; column < panel.value[row].size(); ++column) {
      const double value = panel.value[row][column];
      const bool is_bright = !std::isfinite(value) || is_light(value);
      fmt::format_to(std::back_inserter(lines), "{}\t{}\t{}\t\"{}\"\t{}\n", column, row,
                     number(success_of(value)), cell_text(panel, row, column, has_intervals),
                     is_bright ? 0x101418 : 0xffffff);
    }
  }
  return lines + '\n';
}

/// A cross in every marked cell. With a number it is the outer thirds of both diagonals, which
/// spare the number. With the colour alone it is in the middle, as ends would meet at the corners.
std::string crosses(const HeatmapPanel& panel, bool has_numbers) {
  const double from = has_numbers ? 1.0 : 0.55, to = has_numbers ? 0.64 : 0.0;
  std::string text;
  for (std::size_t row = 0; row < panel.marked.size(); ++row) {
    for (std::size_t column = 0; column < panel.marked[row].size(); ++column) {
      if (!panel.marked[row][column]) continue;
      const auto x = static_cast<double>(column), y = static_cast<double>(row);
      for (const double across : {0.5, -0.5}) {
        for (const double up : {0.5, -0.5}) {
          fmt::format_to(std::back_inserter(text), "{}\t{}\n{}\t{}\n\n", x + from * across,
                         y + from * up, x + to * across, y + to * up);
        }
      }
    }
  }
  return text.empty() ? nothing : text;
}

constexpr double map_gap_x = 74.0, map_gap_y = 72.0,
                 scale_width = 104.0;  ///< between panels, for the scale (px)

/// px
struct CellSize {
  double width, height;
};

/// Where panels are in the body of the frame (px). Their cells have the same size.
struct PanelLayout {
  enum class Content : int { colour, number, interval } content;
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

/// Kinds of blocks (gnuplot's `index`) of the data file; each kind has one block per panel.
enum Block : std::size_t { cell_block, cross_block };

/// A heatmap's data file. Its blocks, each for every panel: the cells (column, row, success rate,
/// text, the text's colour), the crosses.
std::string heatmap_data(const Heatmap& heatmap, const PanelLayout& layout) {
  std::string text = "#column\trow\tsuccess_percent\tlabel\tlabel_colour\n";
  std::string cross_text;
  for (const HeatmapPanel& panel : heatmap.panels) {
    text += cells(panel, layout.content == PanelLayout::Content::interval) + '\n';
    cross_text += crosses(panel, layout.content != PanelLayout::Content::colour) + '\n';
  }
  return text + cross_text;
}

/// A cell for its number, with or without an interval, or for its colour alone: as it fits.
PanelLayout::Content content_of(const Heatmap& heatmap, double room) {
  using Content = PanelLayout::Content;
  const auto columns = static_cast<double>(heatmap.x.size());
  const double most = (room - map_gap_x - scale_width) / columns;
  if (heatmap.x.size() * heatmap.y.size() > most_numbered_cells || most < 60.0) {
    return Content::colour;
  }
  return heatmap.panels.front().low.empty() || most < 116.0 ? Content::number : Content::interval;
}

/// Panels of few cells are as large as their titles and labels need.
CellSize cell_size(const Heatmap& heatmap, PanelLayout::Content content) {
  constexpr double narrowest = 236.0, lowest = 190.0;
  constexpr std::array<CellSize, 3> least = {{{26.0, 22.0}, {60.0, 44.0}, {104.0, 54.0}}};
  const auto& [width, height] = least[static_cast<std::size_t>(content)];
  const double panel = content == PanelLayout::Content::colour ? 350.0 : narrowest;
  const double across = std::max(width, panel / static_cast<double>(heatmap.x.size()));
  if (content == PanelLayout::Content::colour) return {across, std::max(height, 0.82 * across)};
  return {across, std::max(height, lowest / static_cast<double>(heatmap.y.size()))};
}

PanelLayout layout_of(const Heatmap& heatmap, double room) {
  const std::size_t panels = heatmap.panels.size();
  PanelLayout layout{};
  layout.content = content_of(heatmap, room);
  layout.cell = cell_size(heatmap, layout.content);
  layout.panel_width = layout.cell.width * static_cast<double>(heatmap.x.size());
  layout.panel_height = layout.cell.height * static_cast<double>(heatmap.y.size());
  layout.columns = columns_in(room, map_gap_x + scale_width,
                              {std::min<std::size_t>(panels, panels == 4 ? 2 : 3),
                               layout.panel_width, map_gap_x},
                              layout.panel_width)
                       .count;
  layout.rows = (panels + layout.columns - 1) / layout.columns;
  layout.width = std::max(
      std::isfinite(room) ? 0.0 : 560.0,
      static_cast<double>(layout.columns) * (layout.panel_width + map_gap_x) + scale_width);
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

/// The commands that draw panel `i` from the blocks of `<name>.dat` (`heatmap_data`): cells,
/// crosses and numbers.
std::string panel_plot(const Heatmap& heatmap, const std::string& name, std::size_t i,
                       const PanelLayout& layout) {
  const auto block = [&](Block kind) { return heatmap.panels.size() * kind + i; };
  std::string text = fmt::format(
      "plot '{0}.dat' index {1} using 1:2:($1-0.5):($1+0.5):($2-0.5):($2+0.5):(shown($3)) with "
      "boxxyerror fillcolor palette, \\\n"
      "     '' index {2} using 1:2 with lines lw 3.4 lc rgb '#101418' dt 1, \\\n"
      "     '' index {2} using 1:2 with lines lw 1.4 lc rgb '#ffffff' dt 1",
      name, block(cell_block), block(cross_block));
  if (layout.content != PanelLayout::Content::colour) {
    text += fmt::format(
        ", \\\n     '' index {} using 1:2:4:5 with labels font ',8.5' textcolor rgb variable",
        block(cell_block));
  }
  return text + '\n';
}

/// gnuplot's palette and ticks: logarithmic in the distance from a success rate of 100 %.
std::string colour_scale() {
  constexpr std::array<double, 4> error_ticks = {1.0, 2.0, 5.0, 10.0};  // %
  std::string stops, ticks;
  for (std::size_t i = 0; i < viridis.size(); ++i) {
    stops += fmt::format("{}{} '#{:06x}'", i == 0 ? "" : ", ", i, viridis[i]);
  }
  for (const double error : error_ticks) {
    ticks += fmt::format("'{}' {:.6f}, ", success_of(error), -std::log10(error));
  }
  return fmt::format(
      "set palette defined ({2})\nset cbrange [{0:.6f}:{1:.6f}]\n"
      "set cbtics ({3}'≤ {4}' {0:.6f}, '≥ {5}' {1:.6f})\n"
      "shown(success) = -log10(success > {5} ? 100 - {5} : success < {4} ? 100 - {4} : 100 - "
      "success)\n",
      -std::log10(highest_error), -std::log10(lowest_error), stops, ticks,
      success_of(highest_error), success_of(lowest_error));
}

/// The alternative text: each panel's first and last cell.
std::string described(const Heatmap& heatmap) {
  std::string text = fmt::format("Maps of the {} by {} (across) and {} (up).", heatmap.value_label,
                                 heatmap.x_label, heatmap.y_label);
  for (const HeatmapPanel& panel : heatmap.panels) {
    text += fmt::format(" {}: {} % in the lower left cell, {} % in the upper right one.",
                        panel.title, success_text(panel.value.front().front()),
                        success_text(panel.value.back().back()));
  }
  return text;
}

}  // namespace

Figure draw_heatmap(const Heatmap& heatmap, const FigureFile& target) {
  if (heatmap.panels.empty() || heatmap.x.empty() || heatmap.y.empty()) {
    throw InputError("a heatmap without cells");
  }
  const PanelLayout layout = layout_of(heatmap, target.room());
  const CellSize& cell = layout.cell;
  const FigureFrame frame(target, {heatmap.title, heatmap.caption, described(heatmap)},
                          layout.width, layout.height);
  std::string commands = fmt::format(
      "unset grid\nset border 0\nset tics scale 0\n"
      "{}set xrange [-0.5:{}]\nset yrange [-0.5:{}]\n"
      "set xtics {}\nset ytics {}\nunset key\n",
      colour_scale(), static_cast<double>(heatmap.x.size()) - 0.5,
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
                             fmt::format("set cblabel {} offset 0.4,0\n",
                                         gnuplot_text(heatmap.value_label + " (%)"))
                       : "unset colorbox\n";
    commands += panel_plot(heatmap, target.name(), i, layout) + FigureFrame::end_panel();
  }
  return frame.draw(commands, heatmap_data(heatmap, layout));
}

}  // namespace touchdown::render
