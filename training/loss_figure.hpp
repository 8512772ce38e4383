#pragma once

#include <filesystem>

namespace touchdown::training {

/// Draws training and validation loss by iteration from a history's table, the chosen iteration
/// marked. Writes `training.gp` into `folder`, a gnuplot script for anybody who wants another
/// style, and runs it. Returns the figure; empty if gnuplot could not draw it.
std::filesystem::path draw_losses(const std::filesystem::path& history,
                                  const std::filesystem::path& folder, int chosen_iteration);

}  // namespace touchdown::training
