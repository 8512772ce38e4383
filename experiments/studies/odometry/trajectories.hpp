#pragma once

#include "experiments/evaluation/tasks.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/run_directory/directory.hpp"

namespace touchdown::experiments {

/// Writes `trajectories/<engine>_<scene>_<contact>.tum` and `…_ground_truth.tum` in the format of
/// `evo`: a pose every 10 ms, all with the same first pose. The runs are each scene's first in
/// every engine, with the experiment's own sensors. Failed runs are left out.
void write_trajectories(const Evaluation& evaluation, const FittedModels& models,
                        const RunDirectory& directory);

}  // namespace touchdown::experiments
