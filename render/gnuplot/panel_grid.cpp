#include "render/gnuplot/panel_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "render/gnuplot/text.hpp"

namespace touchdown::render {
namespace {

constexpr double above = 84.0;  ///< above the panels: the title and the columns' titles (px)
constexpr double below = 62.0;  ///< below the panels: tics and label of the time axis (px)
constexpr double left = 104.0;  ///< left of the panels: tics and labels (px)
constexpr double gap_x = 22.0, gap_y = 22.0;  ///< between panels (px)
constexpr double line_height = 21.0;          ///< of the caption (px)
constexpr double letter = 9.3;                ///< of the caption, on average (px)

/// At most seven tics between `from` and `to`, far enough from both ends that the labels of
/// neighbouring panels do not touch.
std::string inner_tics(double from, double to) {
  const double step = tick_step(to - from, 7.0);
  const double margin = 0.04 * (to - from);
  return fmt::format("{:.9g},{:.9g},{:.9g}", step * std::ceil((from + margin) / step), step,
                     step * std::floor((to - margin) / step));
}

}  // namespace

double tick_step(double span, double most) {
  const double least = span / most;
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * decade >= least) return step * decade;
  }
  return 10.0 * decade;
}

PanelGrid::PanelGrid(Layout layout, FigureText text)
    : layout_(std::move(layout)), text_(std::move(text)) {
  caption_lines_ = wrapped(text_.caption, static_cast<std::size_t>((width() - 40.0) / letter));
  caption_height_ = line_height * static_cast<double>(1 + std::count(caption_lines_.begin(),
                                                                     caption_lines_.end(), '\n')) +
                    18.0;
}

int PanelGrid::width() const {
  const auto columns = static_cast<double>(layout_.columns.size());
  return static_cast<int>(
      std::lround(left + columns * layout_.panel_width + (columns - 1.0) * gap_x + layout_.right));
}

int PanelGrid::height() const {
  return static_cast<int>(std::lround(y(rows()) - gap_y + below + caption_height_));
}

double PanelGrid::x(std::size_t column) const {
  return left + static_cast<double>(column) * (layout_.panel_width + gap_x);
}

double PanelGrid::y(std::size_t row) const {
  const auto first = layout_.row_heights.begin();
  return std::accumulate(first, first + static_cast<std::ptrdiff_t>(row),
                         above + static_cast<double>(row) * gap_y);
}

double PanelGrid::screen_x(double pixels) const { return pixels / width(); }
double PanelGrid::screen_y(double pixels) const { return 1.0 - pixels / height(); }

std::string PanelGrid::begin(double from, double to) const {
  std::string text = fmt::format(
      "set multiplot\nset xrange [{}:{}]\nset ytics nomirror autofreq font ',11'\n"
      "set xtics {} font ',12'\nset key font ',11' spacing 1.15 samplen 1.6\nunset key\n"
      "set label 101 {} at screen {}, screen {} left font ',15'\n"
      "set label 102 {} at screen {}, screen {} left font ',11' textcolor rgb '#40464e'\n",
      from, to, inner_tics(from, to), gnuplot_text(text_.title), screen_x(20.0), screen_y(24.0),
      gnuplot_text(caption_lines_), screen_x(20.0), screen_y(height() - caption_height_ + 12.0));
  for (std::size_t i = 0; i < layout_.columns.size(); ++i) {
    if (layout_.columns[i].empty()) continue;
    text += fmt::format("set label {} {} at screen {}, screen {} center font ',13'\n", 110 + i,
                        gnuplot_text(layout_.columns[i]),
                        screen_x(x(i) + 0.5 * layout_.panel_width), screen_y(above - 18.0));
  }
  return text;
}

std::string PanelGrid::panel(std::size_t row, std::size_t column, std::string_view y_label) const {
  const double bottom = y(row) + layout_.row_heights[row];
  const bool first = column == 0;
  const bool last = row + 1 == rows();
  std::string text = fmt::format(
      "set lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\n"
      "set bmargin at screen {}\nset format x '{}'\nset format y '{}'\nunset key\n",
      screen_x(x(column)), screen_x(x(column) + layout_.panel_width), screen_y(y(row)),
      screen_y(bottom), last ? "%g" : "", first ? "%g" : "");
  // A label at a fixed position: the labels of all rows are aligned whatever their tics' widths.
  text += first ? fmt::format(
                      "set label 103 {} at screen {}, screen {} center rotate by 90 font ',11'\n",
                      gnuplot_text(y_label), screen_x(24.0), screen_y(0.5 * (y(row) + bottom)))
                : "unset label 103\n";
  if (row + column > 0) {
    text += "unset label 101\nunset label 102\n";
    for (std::size_t i = 0; i < layout_.columns.size(); ++i) {
      text += fmt::format("unset label {}\n", 110 + i);
    }
  }
  text += last ? fmt::format("set xlabel 'time since {} (ms)' font ',12' offset 0,0.2\n",
                             layout_.at ? fmt::format("{:.6g} s", *layout_.at) : "takeoff")
               : "unset xlabel\n";
  return text;
}

std::string PanelGrid::key(std::size_t row, double offset) const {
  return fmt::format("set key at screen {}, screen {} left top Left reverse\n",
                     screen_x(width() - layout_.right + offset), screen_y(y(row) - 2.0));
}

std::string PanelGrid::colour_bar(std::size_t row, double offset, double width) const {
  const double height = layout_.row_heights[row];
  return fmt::format(
      "set colorbox user vertical origin screen {}, screen {} size screen {}, screen {} noborder\n",
      screen_x(this->width() - layout_.right + offset), screen_y(y(row) + height), screen_x(width),
      height / this->height());
}

Figure PanelGrid::draw(const std::filesystem::path& stem, const std::string& commands,
                       const std::vector<PlotData>& data) const {
  return draw_figure(stem, width(), height(), commands + end_multiplot, data, text_);
}

}  // namespace touchdown::render
