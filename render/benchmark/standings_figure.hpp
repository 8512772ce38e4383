#pragma once

#include <filesystem>

#include "render/benchmark/scores.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// The path, without its extension, of the figure of one robot with its sensors.
std::filesystem::path standings_stem(const std::filesystem::path& run_directory,
                                     const Standing& standing);

/// Draws the ranking of the estimators on one robot with its sensors, a row of panels for every
/// noise setting. The left panel has means over all scenes and engines with their intervals, the
/// best above. Bars join estimators that do not differ significantly, as Demšar (2006) draws
/// critical differences; here the simultaneous bands of paired differences decide. The right panel
/// has the worst scene of each. `level` is the confidence level of the intervals. Files and errors
/// as `draw_figure`.
Figure draw_standings_figure(const BenchmarkScores& scores, const std::string& setting,
                             double level, const std::filesystem::path& stem);

/// Draws a figure for every robot with its sensors in the run directory's tables.
void draw_standings_figures(const std::filesystem::path& run_directory, double level);

}  // namespace touchdown::render
