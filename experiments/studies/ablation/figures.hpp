#pragma once

#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/figures/figure_spec.hpp"

namespace touchdown::experiments {

/// The figure of `ablation.csv`: the gain of every step over the step before, a panel per noise
/// setting.
FigureSpec ablation_figure(const Table& ablation, const Experiment& experiment);

}  // namespace touchdown::experiments
