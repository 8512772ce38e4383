#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/interval.hpp"
#include "render/gnuplot/figure.hpp"
#include "scoring/calibration.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::render {

/// What one estimator's probabilities and transitions are worth.
struct ScoreRow {
  std::string name;
  scoring::Calibration calibration;
  std::vector<Interval> contact_frequency;  ///< by bin of the calibration
  scoring::TransitionCounts takeoff, landing;
};

/// One noise setting.
struct ScorePanel {
  std::string title;
  std::vector<ScoreRow> rows;  ///< the same estimators in every panel
};

/// A figure of one aspect of scores, with panels for each noise setting.
struct ScoreFigure {
  std::string title;
  std::vector<ScorePanel> panels;
  std::string caption;
};

/// Draws how often there was contact when an estimator said so with a probability: a curve each,
/// with the number of steps in every bin below. Files as `draw_figure`. Errors: `InputError`
/// without rows; `Error` as `draw_figure`.
Figure draw_reliability_figure(const ScoreFigure& figure, const std::filesystem::path& stem);

/// Draws how latencies of takeoffs and landings are distributed: a histogram per estimator, one
/// pair of panels per noise setting. Early is negative. Files as `draw_figure`. Errors:
/// `InputError` without rows; `Error` as `draw_figure`.
Figure draw_latency_figure(const ScoreFigure& figure, const std::filesystem::path& stem);

}  // namespace touchdown::render
