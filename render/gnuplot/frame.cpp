#include "render/gnuplot/frame.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace touchdown::render {

namespace {

// Of a grid of panels (px): its title and those of the columns above, tics and labels beside and
// below, and the gaps between panels.
constexpr double above = 84.0, left_of = 104.0, below = 62.0, gap = 22.0;
constexpr FigureFrame::Style grid_style = {0.0, 21.0, 18.0, 9.3, 40.0};

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

FigureFrame::FigureFrame(const std::string& title, const std::string& caption, double width,
                         double body_height)
    : FigureFrame({title, caption, {}}, width, body_height, {}) {}

FigureFrame::FigureFrame(FigureText text, double width, double body_height, const Style& style)
    : style_(style),
      text_(std::move(text)),
      caption_lines_(
          wrapped(text_.caption, static_cast<std::size_t>((width - style.margin) / style.letter))),
      width_(width),
      height_(style.title_height + body_height + caption_height()) {}

int FigureFrame::width() const { return static_cast<int>(std::ceil(width_)); }
int FigureFrame::height() const { return static_cast<int>(std::ceil(height_)); }

double FigureFrame::caption_height() const {
  if (caption_lines_.empty()) return 8.0;
  const auto lines = 1 + std::count(caption_lines_.begin(), caption_lines_.end(), '\n');
  return style_.caption_line * static_cast<double>(lines) + style_.caption_padding;
}

Figure FigureFrame::draw(const std::filesystem::path& stem, const std::string& panels,
                         const std::string& data, const std::string& described) const {
  const std::string commands = fmt::format(
      "set label 1 {} at screen {}, screen {} left font ',13'\n"
      "set label 2 {} at screen {}, screen {} left font ',9' textcolor rgb '#40464e'\n"
      "set multiplot\n{}{}",
      gnuplot_text(text_.title), x(16.0), 1.0 - 18.0 / height_, gnuplot_text(caption_lines_),
      x(16.0), (caption_height() - 12.0) / height_, panels, end_multiplot);
  return draw_figure(stem, width(), height(), commands, {{stem.filename().string() + ".dat", data}},
                     {text_.title, text_.caption, described});
}

std::string FigureFrame::panel(double left, double top, double panel_width,
                               double panel_height) const {
  return fmt::format(
      "set lmargin at screen {}\nset rmargin at screen {}\n"
      "set tmargin at screen {}\nset bmargin at screen {}\n",
      x(left), x(left + panel_width), y(top), y(top + panel_height));
}

std::string FigureFrame::colour_bar(double left, double top, double bar_width,
                                    double bar_height) const {
  return fmt::format(
      "set colorbox {} user origin screen {}, screen {} size screen {}, screen {} noborder\n",
      bar_width > bar_height ? "horizontal" : "vertical", x(left), y(top + bar_height),
      x(bar_width), bar_height / height_);
}

std::string FigureFrame::key(double left, double top) const {
  return fmt::format("set key at screen {}, screen {} left top Left reverse\n", x(left), y(top));
}

std::string FigureFrame::label(const std::string& text, double left, double top,
                               const char* style) const {
  return fmt::format("set label {} at screen {}, screen {} {}\n", gnuplot_text(text), x(left),
                     y(top), style);
}

PanelGrid::PanelGrid(Layout layout, FigureText text)
    : layout_(std::move(layout)),
      frame_(std::move(text), left(layout_.columns.size()) - gap + layout_.right,
             top(rows()) - gap + below, grid_style) {}

double PanelGrid::left(std::size_t column) const {
  return left_of + static_cast<double>(column) * (layout_.panel_width + gap);
}

double PanelGrid::top(std::size_t row) const {
  const auto first = layout_.row_heights.begin();
  return std::accumulate(first, first + static_cast<std::ptrdiff_t>(row),
                         above + static_cast<double>(row) * gap);
}

std::string PanelGrid::begin(double from, double to) const {
  std::string text = fmt::format(
      "set multiplot\nset xrange [{}:{}]\nset ytics nomirror autofreq font ',11'\n"
      "set xtics {} font ',12'\nset key font ',11' spacing 1.15 samplen 1.6\nunset key\n"
      "set label 101 {} at screen {}, screen {} left font ',15'\n"
      "set label 102 {} at screen {}, screen {} left font ',11' textcolor rgb '#40464e'\n",
      from, to, inner_tics(from, to), gnuplot_text(frame_.text().title), frame_.x(20.0),
      frame_.y(24.0), gnuplot_text(frame_.caption_lines()), frame_.x(20.0),
      frame_.y(frame_.height() - frame_.caption_height() + 12.0));
  for (std::size_t i = 0; i < layout_.columns.size(); ++i) {
    if (layout_.columns[i].empty()) continue;
    text += fmt::format("set label {} {} at screen {}, screen {} center font ',13'\n", 110 + i,
                        gnuplot_text(layout_.columns[i]),
                        frame_.x(left(i) + 0.5 * layout_.panel_width), frame_.y(above - 18.0));
  }
  return text;
}

std::string PanelGrid::panel(std::size_t row, std::size_t column, std::string_view y_label) const {
  const double height = layout_.row_heights[row];
  const bool first = column == 0;
  const bool last = row + 1 == rows();
  std::string text = fmt::format("{}set format x '{}'\nset format y '{}'\nunset key\n",
                                 frame_.panel(left(column), top(row), layout_.panel_width, height),
                                 last ? "%g" : "", first ? "%g" : "");
  // A label at a fixed position: the labels of all rows are aligned whatever their tics' widths.
  text += first ? fmt::format(
                      "set label 103 {} at screen {}, screen {} center rotate by 90 font ',11'\n",
                      gnuplot_text(y_label), frame_.x(24.0),
                      frame_.y(0.5 * (top(row) + (top(row) + height))))
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
  return frame_.key(keys() + offset, top(row) - 2.0);
}

std::string PanelGrid::colour_bar(std::size_t row, double offset, double width) const {
  const double height = layout_.row_heights[row];
  return fmt::format(
      "set colorbox user vertical origin screen {}, screen {} size screen {}, screen {} noborder\n",
      frame_.x(keys() + offset), frame_.y(top(row) + height), frame_.x(width),
      height / frame_.height());
}

Figure PanelGrid::draw(const std::filesystem::path& stem, const std::string& commands,
                       const std::vector<PlotData>& data) const {
  return draw_figure(stem, frame_.width(), frame_.height(), commands + end_multiplot, data,
                     frame_.text());
}

}  // namespace touchdown::render
