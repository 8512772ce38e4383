#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/tables/table.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws the trade-off between balanced error and extra switches, from `operating_points.csv`: a
/// panel per noise setting, the Pareto front of each estimator's thresholds, and a ring for its own
/// thresholds. `estimators` are all estimators of the experiment; they determine the colours. The
/// caption contains `conditions`. Files and errors as `draw_figure`.
Figure draw_operating_points_figure(const Table& operating_points,
                                    const std::vector<std::string>& estimators,
                                    const std::string& conditions,
                                    const std::filesystem::path& stem);

}  // namespace touchdown::render
