#pragma once

#include <vector>

#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/figures/figure_spec.hpp"

namespace touchdown::experiments {

/// The figure of `transfer.csv`: what each fitted estimator loses in the other engine.
FigureSpec transfer_figure(const Table& transfer, const Experiment& experiment);

/// The figures of `sensitivity.csv`, accuracy over each factor: one for every engine,
/// `sensitivity_<engine>`.
std::vector<FigureSpec> sensitivity_figures(const Table& sensitivity, const Experiment& experiment);

}  // namespace touchdown::experiments
