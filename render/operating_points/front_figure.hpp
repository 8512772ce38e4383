#pragma once

#include <filesystem>

#include "core/table.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// Draws what fewer extra switches cost, from `operating_points.csv`: a panel per noise setting, a
/// curve per estimator through the thresholds that no others do better than, a ring for its own
/// decision. `conditions` says what all of it has in common. Files and errors as `draw_figure`.
Figure draw_operating_points_figure(const Table& operating_points, const std::string& conditions,
                                    const std::filesystem::path& stem);

}  // namespace touchdown::render
