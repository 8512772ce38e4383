#include "render/gnuplot/style.hpp"

#include <array>

#include <fmt/format.h>

#include "render/palette.hpp"

namespace touchdown::render {
namespace {

constexpr const char* style_text =
    R"(# The style of all figures. Change it here and draw them again.
# Text is never markup, so that names may contain _ and ^.
terminal(format, width, height) = \
    format eq 'png' ? sprintf("set terminal pngcairo noenhanced font 'DejaVu Sans,10' size %d,%d background rgb 'white'", width, height) : \
    format eq 'svg' ? sprintf("set terminal svg noenhanced font 'DejaVu Sans,10' fontscale 1.333 size %d,%d dynamic background rgb 'white'", width, height) : \
    sprintf("set terminal pdfcairo noenhanced font 'DejaVu Sans,10' size %.2fin,%.2fin", width / 96.0, height / 96.0)
set encoding utf8
{lines}set linetype 7 lc rgb '#22262b' lw 1.4 pt 1 ps 0.8 dt (1,2)
set linetype 8 lc rgb '#8c6d31' lw 1.8 pt 2 ps 0.8 dt (16,3,2,3)
set linetype cycle 8
set palette defined ({scale})
set border 3 lc rgb '#40464e' lw 0.8
set tics nomirror out scale 0.5 textcolor rgb '#22262b'
set grid back lc rgb '#dfe3e6' lw 0.6 dt 1
set key noautotitle samplen 2.5 spacing 1.1 textcolor rgb '#22262b'
set style fill solid 1.0 noborder
set datafile separator tab
set datafile missing 'NaN'
set minussign
)";

/// Markers and dashes of the curves, which differ in more than their colours.
constexpr std::array<const char*, okabe_ito.size()> looks = {"pt 7 ps 0.7",
                                                             "pt 5 ps 0.7 dt (8,3)",
                                                             "pt 9 ps 0.8 dt (3,2)",
                                                             "pt 13 ps 0.8 dt (8,3,2,3)",
                                                             "pt 11 ps 0.8 dt (12,4)",
                                                             "pt 3 ps 0.8 dt (2,3)"};

}  // namespace

std::string gnuplot_style() {
  std::string lines, scale;
  for (std::size_t i = 0; i < okabe_ito.size(); ++i) {
    lines +=
        fmt::format("set linetype {} lc rgb '#{:06x}' lw 1.8 {}\n", i + 1, okabe_ito[i], looks[i]);
  }
  for (std::size_t i = 0; i < cividis.size(); ++i) {
    scale += fmt::format("{}{} '#{:06x}'", i == 0 ? "" : ", ", i, cividis[i]);
  }
  return fmt::format(style_text, fmt::arg("lines", lines), fmt::arg("scale", scale));
}

}  // namespace touchdown::render
