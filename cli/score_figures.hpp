#pragma once

#include <string>
#include <vector>

#include "cli/pictures.hpp"
#include "experiments/run_experiment.hpp"

namespace touchdown {

/// Draws into the run directory, for every engine: the measurement models that were fitted to its
/// runs, and, at the highlighted noise settings with both wheels pooled, reliability curves and
/// latencies. What an experiment has nothing of is left out.
std::vector<Picture> draw_score_figures(const ExperimentResult& result);

}  // namespace touchdown
