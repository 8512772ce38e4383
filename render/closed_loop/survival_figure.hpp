#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/interval.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// A row of `survival.csv`, as far as it is drawn.
struct SurvivalPoint {
  std::string simulator, scene, law, contact;
  std::string varied;  ///< "rise", "late", "noise", …; empty where nothing is
  double at = 0.0;     ///< its value: in the key's own unit, ms, N·m
  int runs = 0;
  Interval finished;            ///< share
  double landing_speed = 0.0;   ///< m/s; NaN where nobody landed
  double false_takeoffs = 0.0;  ///< per minute of contact
  std::string sensors;
};

/// Of a run directory's table; nothing without one.
std::vector<SurvivalPoint> survival_points(const std::filesystem::path& run_directory);

/// Draws what becomes of the robot in one scene under one law, by who tells it about contact. Where
/// something is varied: the share of runs that finish, and below it the tyres' speed over the
/// ground at landings, over what is varied, a panel per engine. Where nothing is: a row per teller,
/// a point per engine. `level` is that of the intervals. Files and errors as `draw_figure`.
Figure draw_survival_figure(const std::vector<SurvivalPoint>& points, double level,
                            const std::filesystem::path& stem);

/// Of every scene and law that the table knows: `figures/survival_<scene>_<law>`, with `_<varied>`
/// where something is.
void draw_survival_figures(const std::filesystem::path& run_directory, double level);

}  // namespace touchdown::render
