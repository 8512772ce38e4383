#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/verbs.hpp"
#include "experiments/run_experiment.hpp"
#include "render/gnuplot.hpp"

namespace touchdown {

/// A file for people to look at.
struct Picture {
  std::string kind;  ///< "heatmap", "figure", "video"
  std::filesystem::path path;
};

/// Adds a figure's PNG, as a picture of this kind, and its SVG.
void add_figure(std::vector<Picture>& pictures, const std::string& kind, const Figure& figure);

/// Draws what an experiment's result asks for into its run directory and adds the time it took to
/// the provenance.
std::vector<Picture> draw_pictures(ExperimentResult& result, const Session& session);

}  // namespace touchdown
