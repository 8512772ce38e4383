#pragma once

#include <string>
#include <vector>

#include "render/benchmark/scores.hpp"

namespace touchdown::render {

/// Mean balanced accuracy over all scenes and engines: a table for every noise setting, with a row
/// per estimator and a column per robot with its sensors. Here and below, the best of each column
/// is marked, and columns can be sorted.
std::string matrix_html(const BenchmarkScores& scores);

/// Balanced accuracy by scene for one robot with its sensors: a table for every engine and noise
/// setting, with a row per estimator and a column per scene. A star marks scenes that no estimator
/// was fitted to.
std::string scenes_html(const BenchmarkScores& scores, const std::string& setting,
                        const std::vector<std::string>& simulators);

}  // namespace touchdown::render
