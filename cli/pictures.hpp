#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/verbs.hpp"
#include "experiments/run_experiment.hpp"

namespace touchdown {

/// A file for people to look at.
struct Picture {
  std::string kind;  ///< "heatmap", "video"
  std::filesystem::path path;
};

/// Draws what an experiment's result asks for into its run directory and adds the time it took to
/// the provenance.
std::vector<Picture> draw_pictures(ExperimentResult& result, const Session& session);

}  // namespace touchdown
