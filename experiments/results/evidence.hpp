#pragma once

#include "core/tables/table.hpp"
#include "experiments/estimators/fitted_model.hpp"

namespace touchdown::experiments {

/// The value of every evidence curve at its knots, in the units of its channel. The range is that
/// of the fitted rows without the outermost two in a thousand. No rows without models that have
/// curves.
Table evidence_table(const FittedModels& models);

}  // namespace touchdown::experiments
