#pragma once

#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/figures/figure_spec.hpp"

namespace touchdown::experiments {

/// The figure of `learning_curve.csv`: balanced accuracy of every estimator over the seconds of
/// labelled data, a panel per engine and noise setting.
FigureSpec learning_curve_figure(const Table& learning_curve, const Experiment& experiment);

}  // namespace touchdown::experiments
