#include "render/gnuplot/frame.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/table.hpp"

namespace touchdown::render {

namespace {

// Of a grid of panels (px): tics and labels beside, and the gaps between panels.
constexpr double left_of = 104.0, narrow_left_of = 140.0, gap = 22.0;
// Below it, in units of the letters' size.
constexpr double below = 62.0 / 11.0;

/// At most `most` tics between `from` and `to`, far enough from both ends that the labels of
/// neighbouring panels do not touch.
std::string inner_tics(double from, double to, double most) {
  const double step = tick_step(to - from, std::min(7.0, most));
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

/// The average letter of texts of `points`, and a line of them (px).
static double letter_of(double points) { return 0.735 * points; }
static double line_of(double points) { return 1.775 * points; }

/// The height of a text with line ends and of `padding`; `none` for an empty text (px).
static double height_of(const std::string& text, double points, double padding, double none) {
  if (text.empty()) return none;
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  return line_of(points) * static_cast<double>(lines) + padding;
}

FigureFrame::FigureFrame(const FigureFile& file, FigureText text, double width, double body_height,
                         double letters)
    : file_(file), text_(std::move(text)), letters_(letters), width_(width) {
  if (file.print.width_mm) letters_ = std::max(letters, 10.0 * width / file.room());
  if (file.print.caption) {
    const auto fitted = [&](const std::string& all, double points) {
      return wrapped(all, static_cast<std::size_t>((width - 20.0) / letter_of(points)));
    };
    title_lines_ = fitted(text_.title, letters_ + 4.0);
    caption_lines_ = fitted(text_.caption, letters_);
  }
  title_height_ = height_of(title_lines_, letters_ + 4.0, 14.9, 8.0);
  caption_height_ = height_of(caption_lines_, letters_, 14.0, 8.0);
  height_ = title_height_ + body_height + caption_height_;
}

int FigureFrame::width() const { return static_cast<int>(std::ceil(width_)); }
int FigureFrame::height() const { return static_cast<int>(std::ceil(height_)); }

std::string FigureFrame::begin() const {
  return fmt::format(
      "set label 1001 {} at screen {}, screen {} left font ',{}'\n"
      "set label 1002 {} at screen {}, screen {} left font ',{}' textcolor rgb '#40464e'\n"
      "set multiplot\n",
      gnuplot_text(title_lines_), x(16.0), 1.0 - 18.0 / height_, letters_ + 4.0,
      gnuplot_text(caption_lines_), x(16.0), (caption_height_ - 12.0) / height_, letters_);
}

Figure FigureFrame::draw(const std::string& panels, const std::vector<PlotData>& data) const {
  return draw_figure(file_, width(), height(), panels + end_multiplot, data, text_);
}

Figure FigureFrame::draw(const std::string& panels, const std::string& data) const {
  return draw(begin() + panels, {{file_.name() + ".dat", data}});
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

/// Narrower panels where the figure is printed narrow, and titles of columns in as many lines.
PanelGrid::Layout PanelGrid::fitting(Layout layout, double room) {
  const auto columns = static_cast<double>(layout.columns.size());
  const double least = std::min(layout.panel_width, 190.0);
  const double free = (room - left_of - layout.right) / columns - gap;
  layout.panel_width = std::clamp(free, least, layout.panel_width);
  layout.is_narrow = free < least;
  if (layout.is_narrow) {  // texts are larger beside such panels
    layout.right = layout.narrow_right;
    const double width = narrow_left_of + columns * (layout.panel_width + gap) - gap + layout.right;
    layout.letters = std::max(layout.letters, 10.0 * width / room);
    for (double& height : layout.row_heights) height *= 1.5;
  }
  const double letter = letter_of(layout.letters + (layout.is_narrow ? 0.0 : 0.7));
  for (std::string& title : layout.columns) {
    title = wrapped(title, static_cast<std::size_t>(layout.panel_width / letter));
  }
  return layout;
}

PanelGrid::PanelGrid(const FigureFile& file, Layout layout, FigureText text)
    : layout_(fitting(std::move(layout), file.room())),
      frame_(file, std::move(text), left(layout_.columns.size()) - gap + layout_.right,
             top(rows()) - gap + below * layout_.letters, 11.0) {}

double PanelGrid::left(std::size_t column) const {
  return (layout_.is_narrow ? narrow_left_of : left_of) +
         static_cast<double>(column) * (layout_.panel_width + gap);
}

std::size_t PanelGrid::key_lines(std::size_t row) const {
  const bool is_above = layout_.is_narrow && row < layout_.keys.size();
  return is_above ? (layout_.keys[row] + 1) / 2 : 0;
}

double PanelGrid::key_height(std::size_t row) const {
  const auto lines = static_cast<double>(key_lines(row));
  // Clear of the uppermost tic's label.
  return lines > 0.0 ? line_of(layout_.letters) * lines + layout_.letters : 0.0;
}

double PanelGrid::top(std::size_t row) const {
  std::ptrdiff_t lines = 0;  // of the columns' titles
  for (const std::string& title : layout_.columns) {
    lines = std::max(lines, 1 + std::ranges::count(title, '\n'));
  }
  double top = 14.0 + 2.0 * layout_.letters * static_cast<double>(lines) + key_height(0);
  for (std::size_t above = 0; above < row; ++above) {
    top += layout_.row_heights[above] + gap + key_height(above + 1);
  }
  return top;
}

std::string PanelGrid::begin(double from, double to) const {
  std::string text =
      frame_.begin() +
      fmt::format(
          "set xrange [{}:{}]\nset ytics nomirror autofreq font ',11'\n"
          "set xtics {} font ',12'\nset key font ',11' spacing 1.15 samplen 1.6\nunset key\n",
          from, to, inner_tics(from, to, layout_.panel_width / 50.0));
  for (std::size_t i = 0; i < layout_.columns.size(); ++i) {
    const auto lines = std::count(layout_.columns[i].begin(), layout_.columns[i].end(), '\n');
    text += frame_.label(
        layout_.columns[i], left(i) + 0.5 * layout_.panel_width,
        top(0) - key_height(0) - 18.0 - 2.0 * layout_.letters * static_cast<double>(lines),
        "center font ',13'");
  }
  return text;
}

std::string PanelGrid::panel(std::size_t row, std::size_t column, std::string_view y_label) const {
  const double height = layout_.row_heights[row];
  const bool first = column == 0;
  const bool last = row + 1 == rows();
  std::string text = row + column > 0 ? FigureFrame::end_labels : "";
  text += fmt::format("{}set format x '{}'\nset format y '{}'\nunset key\n",
                      frame_.panel(left(column), top(row), layout_.panel_width, height),
                      last ? "%g" : "", first ? "%g" : "");
  // A label at a fixed position: the labels of all rows are aligned whatever their tics' widths.
  if (first) {
    text += frame_.label(std::string(y_label), 24.0, top(row) + 0.5 * height,
                         "center rotate by 90 font ',11'");
  }
  const std::string zero = layout_.at ? fmt::format("{:.6g} s", *layout_.at) : "takeoff";
  text += last ? fmt::format("set xlabel 'time{} (ms)' font ',12' offset 0,0.2\n",
                             layout_.is_narrow ? "" : " since " + zero)
               : "unset xlabel\n";
  return text;
}

std::string PanelGrid::key(std::size_t row, double offset) const {
  if (!layout_.is_narrow) return frame_.key(beside() + offset, top(row) - 2.0);
  return fmt::format("set key maxrows {}\n{}", key_lines(row),
                     frame_.key(16.0, top(row) - key_height(row)));
}

std::string PanelGrid::colour_bar(std::size_t row, double offset, double width) const {
  const double height = layout_.row_heights[row];
  return fmt::format(
      "set colorbox user vertical origin screen {}, screen {} size screen {}, screen {} noborder\n",
      frame_.x(beside() + offset), frame_.y(top(row) + height), frame_.x(width),
      height / frame_.height());
}

}  // namespace touchdown::render
