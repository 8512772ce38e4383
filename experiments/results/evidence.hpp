#pragma once

#include "core/table.hpp"
#include "experiments/estimators/fitted_model.hpp"

namespace touchdown::experiments {

/// What every curve of evidence says at its knots, in the units of what it hears: between the
/// lowest and the highest value of the fitted rows, but for two in a thousand. No rows without
/// models that have curves.
Table evidence_table(const FittedModels& models);

}  // namespace touchdown::experiments
