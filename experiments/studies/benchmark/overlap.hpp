#pragma once

#include "experiments/evaluation/tasks.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// `density_overlap.csv`: how much the densities of every two robots and sensors have in common,
/// ∫ min(p, q), in contact and in the air: those of the first estimator that has some. Nothing
/// where none has.
void write_overlap(const FittedModels& models, const Evaluation& evaluation,
                   const RunDirectory& directory);

}  // namespace touchdown::experiments
