#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/bootstrap.hpp"
#include "experiments/calibration.hpp"
#include "render/gnuplot.hpp"

namespace touchdown {

/// How often there was contact when an estimator said so with a probability.
struct ReliabilityCurve {
  std::string name;
  Calibration calibration;
  std::vector<Interval> contact_frequency;  ///< by bin
};

struct ReliabilityPanel {
  std::string title;
  std::vector<ReliabilityCurve> curves;  ///< the same estimators in every panel
};

/// Reliability curves, one panel per noise setting, with the number of steps in every bin below.
struct ReliabilityFigure {
  std::string title;
  std::vector<ReliabilityPanel> panels;
  std::string caption;
};

/// Files as `draw_figure`. Errors: `InputError` without curves; `Error` as `draw_figure`.
Figure draw_reliability_figure(const ReliabilityFigure& figure, const std::filesystem::path& stem);

}  // namespace touchdown
