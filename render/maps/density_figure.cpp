#include "render/maps/density_figure.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/gnuplot/text.hpp"
#include "render/maps/density_grid.hpp"

namespace touchdown::render {
namespace {

constexpr double panel_width = 268.0, panel_height = 216.0, left_margin = 76.0, gap_x = 62.0;
constexpr double gap_y = 104.0, bar_height = 12.0, top_margin = 46.0;

/// One column of the figure.
struct Column {
  const char* title;
  const char* palette;
  const char* scale;  ///< of its colours
  int value;          ///< in the data file
  const char* bar_label;
};
constexpr Column columns[] = {
    {"in contact", "(0 '#ffffff', 1 '#b9d7ea', 2 '#5aa5d1', 3 '#0072b2', 4 '#00304d')",
     "set logscale cb\nset cbrange [1e-4:1]\n", 3, "density, share of its peak"},
    {"in the air", "(0 '#ffffff', 1 '#f6d3b8', 2 '#ec9656', 3 '#d55e00', 4 '#5c2800')",
     "set logscale cb\nset cbrange [1e-4:1]\n", 4, "density, share of its peak"},
    {"P(contact), flat prior", "(0 '#d55e00', 1 '#f3c4a0', 2 '#f7f7f7', 3 '#9fcae6', 4 '#0072b2')",
     "unset logscale cb\nset cbrange [0:1]\n", 5, "probability of contact"}};

std::string tics_of(int value) {
  if (value == 5) return "set cbtics (0, 0.2, 0.5, 0.8, 1)\n";
  return "set cbtics ('10⁻⁴' 1e-4, '10⁻³' 1e-3, '10⁻²' 1e-2, '0.1' 0.1, '1' 1)\n";
}

/// The panel's points and lines; a density that is not there says so instead.
std::string plot(const DensityRow& row, const std::string& file, std::size_t block, int value) {
  const DensityPeaks peaks = peaks_of(row.grids);
  const bool empty =
      (value == 3 && peaks.contact == 0.0) || (value == 4 && peaks.no_contact == 0.0);
  if (empty) {
    return fmt::format(
        "set label {} at graph 0.5, graph 0.55 center textcolor rgb '#40464e'\nplot NaN\n",
        gnuplot_text("all its torques lie\noutside the model's axes"));
  }
  std::string text = fmt::format("plot {0} index {1} using 1:2:{2} with image", file, block, value);
  return text +
         fmt::format(", \\\n     {} index {} using 1:2 with lines lc rgb '#101418' lw {} dt 1\n",
                     file, block + static_cast<std::size_t>(value) - 2, value == 5 ? 1.1 : 0.8);
}

std::string described(const DensityFigure& figure) {
  std::string text =
      "Densities of knee and wheel torques with a wheel in contact and in the air, and the "
      "probability of contact that they imply.";
  for (const DensityRow& row : figure.rows) {
    const DensityPeaks peaks = peaks_of(row.grids);
    text += fmt::format(" {}: the peaks are {:.3g} and {:.3g} per square newton metre.", row.title,
                        peaks.contact, peaks.no_contact);
  }
  return text;
}

}  // namespace

Figure draw_density_figure(const DensityFigure& figure, const std::filesystem::path& stem) {
  if (figure.rows.empty()) throw InputError("a density figure without models");
  const auto rows = static_cast<double>(figure.rows.size());
  const double body = top_margin + rows * panel_height + (rows - 1.0) * gap_y;
  const FigureFrame frame(figure.title, figure.caption,
                          left_margin + 3.0 * panel_width + 2.0 * gap_x + 30.0, body + 126.0);
  const std::string file = gnuplot_text(stem.filename().string() + ".dat");
  std::string commands =
      "unset key\nset border 15\nset tics out\nunset grid\n"
      "set xlabel 'knee torque (N·m)' offset 0,0.3\nset xtics autofreq\n";
  for (std::size_t r = 0; r < figure.rows.size(); ++r) {
    const double top = top_margin + static_cast<double>(r) * (panel_height + gap_y);
    const DensityAxes axes = axes_of(figure.rows[r].grids);
    for (std::size_t c = 0; c < std::size(columns); ++c) {
      const Column& column = columns[c];
      const double left = left_margin + static_cast<double>(c) * (panel_width + gap_x);
      commands += frame.panel(left, top, panel_width, panel_height);
      if (c == 0) {
        commands += frame.label(figure.rows[r].title, left, top - 34.0, "left font ',11'");
      }
      commands += r + 1 == figure.rows.size()
                      ? frame.colour_bar(left, body + 62.0, panel_width, bar_height) +
                            fmt::format("set cblabel '{}' offset 0,0.5\n", column.bar_label)
                      : "unset colorbox\n";
      commands += fmt::format(
          "set title '{}' offset 0,-0.7\nset palette defined {}\n{}{}"
          "set xrange [{:.5g}:{:.5g}]\nset yrange [{:.5g}:{:.5g}]\nset ylabel '{}' offset 1,0\n",
          column.title, column.palette, column.scale, tics_of(column.value), axes.knee_low,
          axes.knee_high, axes.wheel_low, axes.wheel_high, c == 0 ? "wheel torque (N·m)" : "");
      commands +=
          plot(figure.rows[r], file, r * density_blocks, column.value) + FigureFrame::end_panel();
    }
  }
  return frame.draw(stem, commands, density_data(figure), described(figure));
}

}  // namespace touchdown::render
