#pragma once

#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/figures/figure_spec.hpp"

namespace touchdown::experiments {

/// The figure of `tuning.csv`: the score of every trial, with marks for the defaults and the chosen
/// values.
FigureSpec tuning_figure(const Table& tuning, const Experiment& experiment);

}  // namespace touchdown::experiments
