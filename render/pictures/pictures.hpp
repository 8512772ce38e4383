#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/results/result.hpp"
#include "render/pictures/filmed_run.hpp"

namespace touchdown::render {

/// Draws what an experiment's result asks for into its run directory, with a video of each filmed
/// run, and adds the time it took to the provenance.
void draw_pictures(experiments::ExperimentResult& result, const std::vector<FilmedRun>& filmed,
                   const std::atomic<bool>* stop);

}  // namespace touchdown::render
