#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/transitions.hpp"
#include "render/gnuplot.hpp"

namespace touchdown {

/// One estimator's transitions.
struct LatencyRow {
  std::string name;
  TransitionCounts takeoff, landing;
};

struct LatencyPanel {
  std::string title;
  std::vector<LatencyRow> rows;
};

/// How latencies of takeoffs and landings are distributed: a histogram per estimator, one pair of
/// panels per noise setting. Early is negative.
struct LatencyFigure {
  std::string title;
  std::vector<LatencyPanel> panels;
  std::string caption;
};

/// Files as `draw_figure`. Errors: `InputError` without rows; `Error` as `draw_figure`.
Figure draw_latency_figure(const LatencyFigure& figure, const std::filesystem::path& stem);

}  // namespace touchdown
