#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/interval.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// The drawn columns of a row of `survival.csv`.
struct SurvivalPoint {
  std::string simulator, scene, law, contact;
  std::string varied;  ///< varied quantity: "rise", "delay", "noise", …; or empty
  double at = 0.0;     ///< its value: in the key's own unit, ms, N·m
  int runs = 0;
  Interval finished;            ///< share of the runs
  double landing_speed = 0.0;   ///< RMS, m/s; NaN without landings
  double false_takeoffs = 0.0;  ///< per minute of contact
  std::string sensors;
};

/// The rows of a run directory's table; empty without one.
std::vector<SurvivalPoint> survival_points(const std::filesystem::path& run_directory);

/// Draws closed-loop results in one scene under one law, by contact source. With a varied quantity,
/// there is a panel per engine and a curve per source: the share of runs that finish and, below,
/// the tyres' speed over the ground at landings. Without one, there is a row per source with a
/// point per engine. `estimators` are all estimators of the experiment; they determine the colours.
/// `level` is the confidence level of the intervals. Files and errors as `draw_figure`.
Figure draw_survival_figure(const std::vector<SurvivalPoint>& points,
                            const std::vector<std::string>& estimators, double level,
                            const std::filesystem::path& stem);

/// Draws a figure for every scene and law in the table: `figures/survival_<scene>_<law>`, with
/// `_<varied>` at its end if a quantity is varied.
void draw_survival_figures(const std::filesystem::path& run_directory,
                           const std::vector<std::string>& estimators, double level);

}  // namespace touchdown::render
