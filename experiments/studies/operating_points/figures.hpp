#pragma once

#include <vector>

#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/figures/figure_spec.hpp"

namespace touchdown::experiments {

/// The figure of `operating_points.csv`, balanced error against extra switches: the Pareto front of
/// every estimator over its thresholds, and a ring for its own.
FigureSpec operating_points_figure(const Table& operating_points, const Experiment& experiment);

}  // namespace touchdown::experiments
