#pragma once

#include "experiments/evaluation/tasks.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// Writes `density_overlap.csv`: the overlap ∫ min(p, q) of the fitted densities of every two
/// setups, in contact and in the air. The densities are those of the first estimator that has some;
/// without one, no file is written.
void write_overlap(const FittedModels& models, const Evaluation& evaluation,
                   const RunDirectory& directory);

}  // namespace touchdown::experiments
