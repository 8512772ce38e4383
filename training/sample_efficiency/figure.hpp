#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace touchdown::training {

/// Draws success rate and no-contact recall of both methods against seconds of labelled data, one
/// row per engine, from the table in the run directory. Writes the gnuplot script beside the
/// figure. Returns the figure; empty if gnuplot could not draw it.
std::filesystem::path draw_sample_efficiency(const std::filesystem::path& run_directory,
                                             const std::vector<std::string>& simulators,
                                             const std::string& filter_title);

}  // namespace touchdown::training
