#pragma once

#include "core/table.hpp"
#include "experiments/listening/tasks.hpp"

namespace touchdown::experiments {

/// How much the densities of every two robots and sensors have in common, ∫ min(p, q), in contact
/// and in the air: those of the first estimator that has some. No rows where none has.
Table overlap_table(const FittedModels& models, const Listened& listened);

}  // namespace touchdown::experiments
