#pragma once

#include <vector>

#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/figures/figure_spec.hpp"

namespace touchdown::experiments {

/// The figures of `odometry.csv`, the best contact source above: one for every robot with its
/// sensors, `odometry_<robot>_<sensors>`.
std::vector<FigureSpec> odometry_figures(const Table& odometry, const Experiment& experiment);

}  // namespace touchdown::experiments
