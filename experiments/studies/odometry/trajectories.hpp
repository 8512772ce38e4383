#pragma once

#include "experiments/fitting/fitting.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// Writes, of each scene's first run in every engine as the experiment's own sensors hear it,
/// `trajectories/<engine>_<scene>_<contact>.tum` and what is true, `…_ground_truth.tum`, every 10
/// ms as `evo` reads them, begun alike. Nothing of a run that failed.
void write_trajectories(const Evaluation& evaluation, const FittedModels& models,
                        const RunDirectory& directory);

}  // namespace touchdown::experiments
