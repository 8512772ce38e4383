#include "render/curves/latency_figure.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/error.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/gnuplot/text.hpp"

namespace touchdown::render {
namespace {

constexpr double panel_width = 310.0, row_height = 42.0, names = 190.0, numbers = 150.0;
constexpr double gap_y = 94.0, right_margin = 12.0;

/// Where all histograms of one kind lie.
std::array<double, 2> range_of(const LatencyFigure& figure, const LatencyKind& kind) {
  scoring::LatencyHistogram all;
  for (const LatencyPanel& panel : figure.panels) {
    for (const LatencyRow& row : panel.rows) all += (row.*kind.counts).latency;
  }
  std::array<double, 2> range = {-30.0, 50.0};
  for (std::size_t b = 0; b < all.events.size(); ++b) {
    if (all.events[b] == 0) continue;
    range[0] = std::min(range[0], scoring::LatencyHistogram::centre_ms(b) - 5.0);
    range[1] = std::max(range[1], scoring::LatencyHistogram::centre_ms(b) + 5.0);
  }
  return range;
}

std::string described(const LatencyFigure& figure) {
  std::string text = "Mean latencies in milliseconds, takeoff / landing.";
  for (const LatencyPanel& panel : figure.panels) {
    text += fmt::format(" {}:", panel.title);
    for (std::size_t r = 0; r < panel.rows.size(); ++r) {
      const LatencyRow& row = panel.rows[r];
      text += fmt::format("{} {} {:.1f} / {:.1f}", r > 0 ? "," : "", row.name,
                          1e3 * row.takeoff.latency_mean(), 1e3 * row.landing.latency_mean());
    }
    text += '.';
  }
  return text;
}

}  // namespace

Figure draw_latency_figure(const LatencyFigure& figure, const std::filesystem::path& stem) {
  if (figure.panels.empty() || figure.panels.front().rows.empty()) {
    throw InputError("a latency figure without rows");
  }
  const std::size_t rows = figure.panels.front().rows.size();
  const double height = row_height * static_cast<double>(rows);
  const FigureFrame frame(figure.title, figure.caption,
                          names + 2.0 * (panel_width + numbers) + right_margin,
                          static_cast<double>(figure.panels.size()) * (height + gap_y));
  const std::string file = gnuplot_text(stem.filename().string() + ".dat");
  std::string commands = fmt::format(
      "unset key\nset grid noytics\nset style fill solid 0.55\nset yrange [-0.15:{}]\nset border "
      "1\n",
      static_cast<double>(rows));
  std::size_t block = 0, means = figure.panels.size() * latency_kinds.size() * rows;
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    std::string estimators;
    for (std::size_t r = 0; r < rows; ++r) {
      estimators +=
          fmt::format("{}{} {}", r > 0 ? ", " : "", gnuplot_text(figure.panels[p].rows[r].name),
                      static_cast<double>(rows - 1 - r) + 0.3);
    }
    for (std::size_t k = 0; k < latency_kinds.size(); ++k) {
      const auto [low, high] = range_of(figure, latency_kinds[k]);
      commands +=
          frame.panel(names + static_cast<double>(k) * (panel_width + numbers),
                      24.0 + static_cast<double>(p) * (height + gap_y), panel_width, height);
      commands += fmt::format(
          "set title {} offset 0,-0.6\nset xrange [{}:{}]\nset ytics scale 0 ({})\n"
          "set xlabel '{} latency (ms)'\n"
          "set arrow from 0,graph 0 to 0,graph 1 nohead back lc rgb '#6b747d' lw 1.2 dt 1\nplot ",
          gnuplot_text(figure.panels[p].title), low, high, k == 0 ? estimators : "'' 0",
          latency_kinds[k].name);
      for (std::size_t r = 0; r < rows; ++r) {
        commands += fmt::format(
            "{0} index {1} using 1:2:3 with filledcurves lt {2}, {0} index {1} using 1:3 with "
            "lines "
            "lt {2} lw 1.2 dt 1, \\\n     ",
            file, block++, r + 1);
      }
      commands += fmt::format(
          "{0} index {1} using 1:2:(0):(0.9) with vectors nohead lw 1.8 dt 1 lc rgb '#101418', \\\n"
          "     '' index {1} using ({2}):($2+0.4):3 with labels left offset 1.2,0 font ',9' "
          "textcolor rgb '#22262b'\n",
          file, means++, high);
      commands += FigureFrame::end_panel();
    }
  }
  return frame.draw(stem, commands, latency_data(figure), described(figure));
}

}  // namespace touchdown::render
