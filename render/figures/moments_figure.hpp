#pragma once

#include <filesystem>
#include <vector>

#include "core/table.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws densities of the simulated |torque| in each engine, with a panel for each joint in each
/// contact state. Above each panel are the means ± standard deviations of the engines and of the
/// real robot, which has no density. `moments` and `densities` are a run's tables of that name
/// (docs/explanation/realism.md); an engine without samples has no curve. Files and errors as
/// `draw_figure`.
Figure draw_moments_figure(const Table& moments, const Table& densities,
                           const std::filesystem::path& stem);

}  // namespace touchdown::render
