#include "render/heatmap_plot.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace touchdown {
namespace {

constexpr const char* dashes[] = {"1", "(14,5)", "(4,4)"};

}  // namespace

const char* line_dash(std::size_t level) { return dashes[std::min(level, std::size(dashes) - 1)]; }

std::string heatmap_plot(const Heatmap& heatmap, const std::string& name, std::size_t i,
                         bool numbers, const CellSize& cell) {
  const std::size_t panels = heatmap.panels.size(), levels = heatmap.iso_levels.size();
  std::string text = fmt::format(
      "plot '{}.dat' index {} using 1:2:($1-0.5):($1+0.5):($2-0.5):($2+0.5):3 with boxxyerror "
      "fillcolor palette, \\\n     '' index {} using 1:2 with lines lw 0.7 lc rgb '#aab0b8' dt 1",
      name, i, panels * (1 + levels) + i);
  for (std::size_t level = 0; level < levels; ++level) {
    const std::size_t index = panels * (1 + level) + i;
    text += fmt::format(
        ", \\\n     '' index {0} using 1:2 with lines lw 3.6 lc rgb '#ffffff' dt 1"
        ", \\\n     '' index {0} using 1:2 with lines lw 1.5 lc rgb '#101418' dt {1}",
        index, line_dash(level));
  }
  if (numbers) {
    constexpr double reach = 1.6;  // pixels
    for (int turn = 0; turn < 8; ++turn) {
      text += fmt::format(
          ", \\\n     '' index {} using ($1+({:.4f})):($2+({:.4f})):4:6 with labels font ',8.5' "
          "textcolor rgb variable",
          i, reach * std::cos(turn * M_PI / 4) / cell.width,
          reach * std::sin(turn * M_PI / 4) / cell.height);
    }
    text += fmt::format(
        ", \\\n     '' index {} using 1:2:4:5 with labels font ',8.5' textcolor rgb variable", i);
  }
  return text + '\n';
}

}  // namespace touchdown
