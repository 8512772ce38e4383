#pragma once

#include <filesystem>
#include <vector>

#include "core/table.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws densities of |torque| of each engine's robot, a panel for each joint in each state of
/// contact, and above them mean ± standard deviation beside the real robot's, of which no more is
/// known. `moments` and `densities` are a run's tables of that name (docs/realism.md); an engine
/// without samples has no curve. Files and errors as `draw_figure`.
Figure draw_moments_figure(const Table& moments, const Table& densities,
                           const std::filesystem::path& stem);

}  // namespace touchdown::render
