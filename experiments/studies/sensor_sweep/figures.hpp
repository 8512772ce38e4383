#pragma once

#include <vector>

#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/figures/figure_spec.hpp"

namespace touchdown::experiments {

/// The figures of `sensor_sweep.csv`, accuracy over each disturbance: one for every engine,
/// `sensor_sweep_<engine>`.
std::vector<FigureSpec> sensor_sweep_figures(const Table& sweep, const Experiment& experiment);

}  // namespace touchdown::experiments
