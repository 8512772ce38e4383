#include "render/gnuplot/frame.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/gnuplot/text.hpp"

namespace touchdown::render {
namespace {

constexpr double title_height = 38.0, caption_line = 16.0, caption_padding = 14.0;
constexpr double letter_width = 6.6;  ///< of the caption, on average (px)

double caption_height(const std::string& caption) {
  if (caption.empty()) return 8.0;
  const auto lines = 1 + std::count(caption.begin(), caption.end(), '\n');
  return caption_line * static_cast<double>(lines) + caption_padding;
}

}  // namespace

FigureFrame::FigureFrame(const std::string& title, const std::string& caption, double width,
                         double body_height)
    : title_(title),
      caption_(caption),
      caption_lines_(wrapped(caption, static_cast<std::size_t>(width / letter_width))),
      width_(width),
      height_(title_height + body_height + caption_height(caption_lines_)) {}

int FigureFrame::width() const { return static_cast<int>(std::ceil(width_)); }
int FigureFrame::height() const { return static_cast<int>(std::ceil(height_)); }
double FigureFrame::y(double pixels) const { return 1.0 - (title_height + pixels) / height_; }

Figure FigureFrame::draw(const std::filesystem::path& stem, const std::string& panels,
                         const std::string& data, const std::string& described) const {
  const std::string commands = fmt::format(
      "set label 1 {} at screen {}, screen {} left font ',13'\n"
      "set label 2 {} at screen {}, screen {} left font ',9' textcolor rgb '#40464e'\n"
      "set multiplot\n{}{}",
      gnuplot_text(title_), x(16.0), 1.0 - 18.0 / height_, gnuplot_text(caption_lines_), x(16.0),
      (caption_height(caption_lines_) - 12.0) / height_, panels, end_multiplot);
  return draw_figure(stem, width(), height(), commands, {{stem.filename().string() + ".dat", data}},
                     {title_, caption_, described});
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

}  // namespace touchdown::render
