#pragma once

#include "experiments/evaluation/tasks.hpp"
#include "experiments/run_directory/directory.hpp"
#include "experiments/studies/odometry/config.hpp"

namespace touchdown::experiments {

/// Measures the trajectories of each scene's first run with the first noise realisation, as TUM
/// texts: of the run the true one and those of the oracles, of each in-domain prediction its own. A
/// text has a pose every 10 ms; all have the same first pose. `runs` is the number of test runs of
/// a scene.
Measure trajectories(const OdometryStudyConfig& config, int runs);

/// Writes them as `trajectories/<engine>_<scene>_<contact>.tum` and `…_ground_truth.tum`, the
/// format of `evo`. Failed runs are left out.
void write_trajectories(const Evaluation& evaluation, const RunDirectory& directory);

}  // namespace touchdown::experiments
