#pragma once

#include <string>
#include <vector>

#include "core/interval.hpp"
#include "scoring/calibration.hpp"

namespace touchdown::render {

/// How often there was contact when an estimator said so with a probability.
struct ReliabilityCurve {
  std::string name;
  scoring::Calibration calibration;
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

}  // namespace touchdown::render
