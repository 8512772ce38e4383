#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/interval.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// A row of `odometry.csv`, as far as it is drawn.
struct OdometryError {
  std::string simulator, scene, contact, robot, sensors;
  Interval rms;  ///< m
};

/// Of a run directory's table; nothing without one.
std::vector<OdometryError> odometry_errors(const std::filesystem::path& run_directory);

/// Draws how wrong odometry is by who tells it about contact, with one robot and its sensors: a
/// panel per scene, a row per source, the best above, a point with its interval per engine. `level`
/// is that of the intervals. `errors` are of one robot and its sensors. Files and errors as
/// `draw_figure`.
Figure draw_odometry_figure(const std::vector<OdometryError>& errors, double level,
                            const std::filesystem::path& stem);

/// Of every robot and its sensors that the table knows: `figures/odometry_<robot>_<sensors>`.
void draw_odometry_figures(const std::filesystem::path& run_directory, double level);

}  // namespace touchdown::render
