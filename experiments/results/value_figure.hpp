#pragma once

#include <string>

#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/figures/figure_spec.hpp"

namespace touchdown::experiments {

/// The success rate of every estimator in one engine over the values of what a study varies, as
/// figure
/// `<table>_<engine>` of `tables/<table>.csv`: a panel per name in the column `varied`. The table
/// has the columns `simulator`, `estimator`, `value` and `success` with its interval. Title and
/// caption are left to the study; the axis of values is `value_title`.
FigureSpec accuracy_by_value(const Table& table, const std::string& name, const std::string& varied,
                             const std::string& value_title, const std::string& simulator,
                             const Experiment& experiment);

}  // namespace touchdown::experiments
