#pragma once

#include "core/fields.hpp"
#include "experiments/config/experiment.hpp"

namespace touchdown::experiments {

/// Describes the section `hyperparameters`: values by estimator, then name, also by engine, or the
/// file of a tuning.
void describe_hyperparameters(Fields& fields, Experiment& experiment);

}  // namespace touchdown::experiments
