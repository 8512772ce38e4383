#pragma once

#include <vector>

#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/figures/figure_spec.hpp"

namespace touchdown::experiments {

/// The figures of `survival.csv`, by contact source: one for every scene, law and varied quantity,
/// `survival_<scene>_<law>[_<varied>]`.
std::vector<FigureSpec> survival_figures(const Table& survival, const Experiment& experiment);

}  // namespace touchdown::experiments
