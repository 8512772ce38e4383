#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/interval.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// The drawn columns of a row of `odometry.csv`.
struct OdometryError {
  std::string simulator, scene, contact, robot, sensors;
  Interval rms;  ///< m
};

/// The rows of a run directory's table; empty without one.
std::vector<OdometryError> odometry_errors(const std::filesystem::path& run_directory);

/// Draws the odometry error by contact source for one robot with its sensors: a panel per scene, a
/// row per source with the best above, a point with its interval per engine. All `errors` belong to
/// one robot with its sensors. `level` is the confidence level of the intervals. Files and errors
/// as `draw_figure`.
Figure draw_odometry_figure(const std::vector<OdometryError>& errors, double level,
                            const std::filesystem::path& stem);

/// Draws a figure for every robot with its sensors in the table:
/// `figures/odometry_<robot>_<sensors>`.
void draw_odometry_figures(const std::filesystem::path& run_directory, double level);

}  // namespace touchdown::render
