#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/interval.hpp"
#include "render/gnuplot/figure.hpp"
#include "scoring/score.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::render {

/// The calibration and the latencies of one estimator.
struct ScoreRow {
  std::string name;
  std::size_t line_type = 1;  ///< `line_type_of` the estimator
  scoring::Calibration calibration;
  std::vector<Interval> contact_frequency;  ///< by bin of the calibration
  scoring::TransitionCounts takeoff, landing;
};

/// One noise setting.
struct ScorePanel {
  std::string title;
  std::vector<ScoreRow> rows;  ///< the same estimators in every panel
};

/// A figure of scores, with panels for each noise setting.
struct ScoreFigure {
  std::string title;
  std::vector<ScorePanel> panels;
  std::string caption;
};

/// Draws a reliability diagram: for each estimator the share of steps in contact against the stated
/// probability of contact, with the number of steps in every bin below. Files as `draw_figure`.
/// Errors: `InputError` without rows; `Error` as `draw_figure`.
Figure draw_reliability_figure(const ScoreFigure& figure, const std::filesystem::path& stem);

/// Draws the distributions of takeoff and landing latencies: a histogram per estimator, one pair of
/// panels per noise setting. Early detections have negative latency. Files as `draw_figure`.
/// Errors: `InputError` without rows; `Error` as `draw_figure`.
Figure draw_latency_figure(const ScoreFigure& figure, const std::filesystem::path& stem);

}  // namespace touchdown::render
