#pragma once

#include <string>
#include <vector>

#include "render/benchmark/scores.hpp"

namespace touchdown::render {

/// Estimators down, robots with their sensors across: means over all scenes and engines, a table
/// for every noise setting. Here and below the best of a column is marked, and columns sort.
std::string matrix_html(const BenchmarkScores& scores);

/// Estimators down, scenes across: a table for every engine and noise setting of one robot with its
/// sensors. Scenes that nothing was fitted to have a star.
std::string scenes_html(const BenchmarkScores& scores, const std::string& setting,
                        const std::vector<std::string>& simulators);

}  // namespace touchdown::render
