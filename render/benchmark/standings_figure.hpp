#pragma once

#include <filesystem>

#include "render/benchmark/scores.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// The file, without its ending, of the figure of one robot with its sensors.
std::filesystem::path standings_stem(const std::filesystem::path& run_directory,
                                     const Standing& place);

/// Draws who stands where with one robot and its sensors, a row of panels for every noise setting:
/// means over all scenes and engines with their intervals, the best above; bars beside them join
/// those who cannot be told apart (Demšar 2006 draws critical differences so; here it is the
/// simultaneous bands of paired differences that decide); and the worst scene of each. `level` is
/// that of the intervals. Files and errors as `draw_figure`.
Figure draw_standings_figure(const BenchmarkScores& scores, const std::string& setting,
                             double level, const std::filesystem::path& stem);

/// Of every robot and its sensors that the run directory's tables know.
void draw_standings_figures(const std::filesystem::path& run_directory, double level);

}  // namespace touchdown::render
