#include "render/heatmap.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/error.hpp"
#include "render/iso_lines.hpp"

namespace touchdown {
namespace {

using Matrix = std::vector<std::vector<double>>;

void check(const Heatmap& heatmap) {
  if (heatmap.panels.empty() || heatmap.x.empty() || heatmap.y.empty()) {
    throw InputError("a heatmap without cells");
  }
  for (const HeatmapPanel& panel : heatmap.panels) {
    if (!panel.marked.empty() && panel.marked.size() != heatmap.y.size()) {
      throw InputError(
          fmt::format("heatmap '{}': expected {} rows of marks", panel.title, heatmap.y.size()));
    }
    for (const Matrix* matrix : {&panel.value, &panel.low, &panel.high}) {
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

struct Range {
  double low, high;
};

Range colour_range(const Heatmap& heatmap) {
  double low = heatmap.low, high = heatmap.high;
  for (const HeatmapPanel& panel : heatmap.panels) {
    for (const auto& row : panel.value) {
      for (const double value : row) {
        if (!std::isfinite(value)) continue;
        if (!std::isfinite(heatmap.low)) low = std::isfinite(low) ? std::min(low, value) : value;
        if (!std::isfinite(heatmap.high))
          high = std::isfinite(high) ? std::max(high, value) : value;
      }
    }
  }
  if (!std::isfinite(low)) low = 0.0;
  if (!std::isfinite(high)) high = 1.0;
  if (high - low < 1e-3) low = high - 1e-3;
  return {low, high};
}

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

/// Both diagonals of every marked cell, as lines of a data block.
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
  return text.empty() ? "NaN\tNaN\n\n" : text;
}

/// One block per panel (gnuplot's `index`), then one per panel with its iso-lines, then one per
/// panel with its crosses.
std::string table(const Heatmap& heatmap, const Range& range) {
  std::string text = "#column\trow\tvalue\tlabel\tlabel_colour\n";
  for (const HeatmapPanel& panel : heatmap.panels) {
    for (std::size_t row = 0; row < heatmap.y.size(); ++row) {
      for (std::size_t column = 0; column < heatmap.x.size(); ++column) {
        const double value = panel.value[row][column];
        const double share = (value - range.low) / (range.high - range.low);
        // Cividis is dark below its middle.
        const bool dark = std::isfinite(value) && share < 0.55;
        fmt::format_to(std::back_inserter(text), "{}\t{}\t{}\t\"{}\"\t{}\n", column, row,
                       number(value), cell_text(panel, row, column), dark ? 0xffffff : 0x101418);
      }
    }
    text += "\n\n";
  }
  for (const HeatmapPanel& panel : heatmap.panels) {
    bool any = false;
    for (const double level : heatmap.iso_levels) {
      for (const IsoPiece& piece : iso_lines(panel.value, level)) {
        fmt::format_to(std::back_inserter(text), "{}\t{}\t{}\n{}\t{}\t{}\n\n", piece[0][0],
                       piece[0][1], level, piece[1][0], piece[1][1], level);
        any = true;
      }
    }
    text += any ? "\n" : "NaN\tNaN\tNaN\n\n\n";
  }
  for (const HeatmapPanel& panel : heatmap.panels) text += crosses(panel) + "\n";
  return text;
}

std::string tics(const std::vector<double>& values) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += fmt::format("{}'{:.4g}' {}", i == 0 ? "" : ", ", values[i], i);
  }
  return "(" + text + ")";
}

}  // namespace

Figure draw_heatmap(const Heatmap& heatmap, const std::filesystem::path& stem) {
  check(heatmap);
  const Range range = colour_range(heatmap);
  const std::size_t panels = heatmap.panels.size();
  const std::size_t columns = std::min<std::size_t>(panels, panels == 4 ? 2 : 3);
  const std::size_t rows = (panels + columns - 1) / columns;
  const bool intervals = !heatmap.panels.front().low.empty();
  const double cell_width = intervals ? 86.0 : 60.0;
  const double cell_height = intervals ? 50.0 : 44.0;

  // A fixed grid in pixels: every panel the same size, one colour bar for all.
  const double panel_width = cell_width * static_cast<double>(heatmap.x.size());
  const double panel_height = cell_height * static_cast<double>(heatmap.y.size());
  const double gap_x = 74.0, gap_y = 72.0, bar = 92.0;
  const double width = std::max(560.0, static_cast<double>(columns) * (panel_width + gap_x) + bar);
  std::string note = heatmap.caption;
  if (!heatmap.iso_levels.empty()) {
    note += fmt::format(" Red lines: {} of {:.4g}.", heatmap.value_label,
                        fmt::join(heatmap.iso_levels, " and "));
  }
  const std::string caption = wrapped(note, static_cast<std::size_t>(width / 6.6));
  const double caption_height =
      16.0 * static_cast<double>(1 + std::count(caption.begin(), caption.end(), '\n')) + 14.0;
  const double title_height = 38.0;
  const double height =
      title_height + static_cast<double>(rows) * (panel_height + gap_y) + caption_height;

  const std::string name = stem.filename().string();
  std::string commands = fmt::format(
      "unset grid\nset border 0\nset tics scale 0\n"
      "set label 1 {} at screen 0.02, screen {} left font ',13'\n"
      "set label 2 {} at screen 0.02, screen {} left font ',9' textcolor rgb '#40464e'\n"
      "set multiplot\n"
      "set cbrange [{}:{}]\nset xrange [-0.5:{}]\nset yrange [-0.5:{}]\n"
      "set xtics {}\nset ytics {}\n",
      gnuplot_text(heatmap.title), 1.0 - 18.0 / height, gnuplot_text(caption),
      (caption_height - 12.0) / height, range.low, range.high,
      static_cast<double>(heatmap.x.size()) - 0.5, static_cast<double>(heatmap.y.size()) - 0.5,
      tics(heatmap.x), tics(heatmap.y));
  for (std::size_t i = 0; i < panels; ++i) {
    const auto column = static_cast<double>(i % columns);
    const std::size_t row_number = i / columns;
    const auto row = static_cast<double>(row_number);
    const double left = column * (panel_width + gap_x) + gap_x - 8.0;
    const double top = title_height + row * (panel_height + gap_y) + 22.0;
    commands += fmt::format(
        "set lmargin at screen {}\nset rmargin at screen {}\n"
        "set tmargin at screen {}\nset bmargin at screen {}\n"
        "set title {} offset 0,-0.6\nset xlabel {} offset 0,0.4\nset ylabel {} offset 0.6,0\n",
        left / width, (left + panel_width) / width, 1.0 - top / height,
        1.0 - (top + panel_height) / height, gnuplot_text(heatmap.panels[i].title),
        gnuplot_text(heatmap.x_label), gnuplot_text(i % columns == 0 ? heatmap.y_label : ""));
    commands += i == 0 ? fmt::format(
                             "set colorbox user origin screen {}, screen {} size screen {}, "
                             "screen {} noborder\nset cblabel {} offset 0.4,0\n"
                             "set cbtics format '%.3g'\n",
                             1.0 - (bar - 16.0) / width, 1.0 - (top + panel_height) / height,
                             14.0 / width, panel_height / height, gnuplot_text(heatmap.value_label))
                       : "unset colorbox\n";
    commands += fmt::format(
        "plot '{0}.dat' index {1} using 1:2:($1-0.5):($1+0.5):($2-0.5):($2+0.5):3 "
        "with boxxyerror fillcolor palette, \\\n"
        "     '' index {3} using 1:2 with lines lw 0.7 lc rgb '#808890' dt 1, \\\n"
        "     '' index {2} using 1:2 with lines lw 2.4 lc rgb '#ffffff' dt 1, \\\n"
        "     '' index {2} using 1:2 with lines lw 1.2 lc rgb '#c0392b' dt 1, \\\n"
        "     '' index {1} using 1:2:4:5 with labels font ',8.5' textcolor rgb variable\n"
        "unset label 1\nunset label 2\n",
        name, i, panels + i, 2 * panels + i);
  }
  commands += "unset multiplot\nreset\nload 'style.gp'\n";
  return draw_figure(stem, static_cast<int>(std::ceil(width)), static_cast<int>(std::ceil(height)),
                     commands, {{name + ".dat", table(heatmap, range)}});
}

}  // namespace touchdown
