#include "render/report/noise.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "experiments/estimators/registry.hpp"
#include "experiments/tables/captions.hpp"
#include "render/report/map.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {
namespace {

using Rows = std::vector<experiments::CellSummary>;

/// A noise level that a study varies.
struct NoiseAxis {
  double noise::NoiseCell::*level;
  std::string label, unit, name;
};

/// Two of them, combined.
struct NoiseGrid {
  NoiseAxis x, y;
};

/// The distinct levels, ascending.
std::vector<double> levels(const Rows& rows, const NoiseAxis& axis) {
  std::set<double> values;
  for (const experiments::CellSummary& row : rows) values.insert(row.cell.*axis.level);
  return {values.begin(), values.end()};
}

template <typename Wanted>
Rows rows_that(const Wanted& wanted, const Rows& rows) {
  Rows found;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(found), wanted);
  return found;
}

bool is_among(const std::vector<double>& levels, double level) {
  return std::find(levels.begin(), levels.end(), level) != levels.end();
}

std::string says(const experiments::CellSummary& row, const NoiseGrid& grid) {
  const auto level = [&](const NoiseAxis& axis) {
    return fmt::format("{} {:.4g} {}", axis.name, row.cell.*axis.level, axis.unit);
  };
  std::string text = fmt::format("{}, {}: {}, {}: success rate {}",
                                 simulators::simulator_title(row.condition.test_simulator),
                                 experiments::estimator_title(row.condition.estimator),
                                 level(grid.y), level(grid.x), with_interval(row.success));
  if (std::isfinite(row.always_contact)) {
    text += fmt::format("; always contact {:.3f}", row.always_contact);
  }
  return text;
}

ReportMap map_of(const Rows& rows, const NoiseGrid& grid, double low) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  ReportMap map{.title = {},
                .x_label = grid.x.label,
                .y_label = grid.y.label,
                .x = levels(rows, grid.x),
                .y = levels(rows, grid.y),
                .cells = {},
                .low = low,
                .high = 1.0,
                .iso_levels = {0.90, 0.95, 0.98}};
  map.cells.assign(map.y.size(),
                   std::vector<MapCell>(map.x.size(), {nan, nan, "not part of this study"}));
  for (const experiments::CellSummary& row : rows) {
    const auto c = std::find(map.x.begin(), map.x.end(), row.cell.*grid.x.level);
    const auto r = std::find(map.y.begin(), map.y.end(), row.cell.*grid.y.level);
    map.cells[static_cast<std::size_t>(r - map.y.begin())][static_cast<std::size_t>(
        c - map.x.begin())] = {row.success.estimate, row.always_contact, says(row, grid)};
  }
  return map;
}

/// One grid: a choice of estimators, a map per engine and estimator, a line that reads out a cell.
std::string grid_html(const Rows& rows, const NoiseGrid& grid,
                      const std::vector<std::string>& simulators, const std::string& name) {
  // Below what a constant answer earns, how bad it is does not matter: keep the colours for above.
  double least = 1.0, constant = 1.0;
  for (const experiments::CellSummary& row : rows) {
    least = std::fmin(least, row.success.estimate);
    constant = std::fmin(constant, row.always_contact);
  }
  if (constant < 1.0) least = std::max(least, constant);
  const double low = std::floor(least * 20.0 - 1e-9) / 20.0;
  const bool fine = levels(rows, grid.x).size() > 8;
  std::string choice = "<fieldset class=\"choice\"><legend>Estimator</legend>\n",
              maps = fmt::format("<div class=\"maps{}\">\n", fine ? " fine" : "");
  bool first = true;
  for (const std::string& estimator : scored_estimators(rows)) {
    if (estimator == experiments::always_contact_name) continue;
    const std::string title = experiments::estimator_title(estimator);
    choice += fmt::format("<label><input type=\"radio\" name=\"{}\" value=\"{}\"{}>{}</label>\n",
                          name, escaped(estimator), first ? " checked" : "", escaped(title));
    first = false;
    for (const std::string& simulator : simulators) {
      const Rows own = rows_that(
          [&](const experiments::CellSummary& row) {
            return row.condition.estimator == estimator &&
                   row.condition.test_simulator == simulator;
          },
          rows);
      if (own.empty()) continue;
      const std::string engine = simulators::simulator_title(simulator);
      ReportMap map = map_of(own, grid, low);
      map.title = fmt::format("{}, {}: success rate", title, engine);
      maps += fmt::format(
          "<figure data-estimator=\"{}\"><figcaption>{}: {}</figcaption>\n{}</figure>\n",
          escaped(estimator), escaped(engine), escaped(title), map_svg(map));
    }
  }
  return fmt::format(
      "<div class=\"heatmaps\">\n{}</fieldset>\n<p class=\"readout\" aria-live=\"polite\">Point at "
      "a cell, tap it, or use the arrow keys: its numbers appear here.</p>\n{}</div>\n<p "
      "class=\"note\">Colours run from {:.2f} and less (dark) to 1 (light). Lines: success rates "
      "of 0.90, 0.95 and 0.98. A struck-out cell does no better than always saying “contact”. The "
      "same numbers are in the table “Success” below.</p>\n</div>\n",
      choice, maps, low);
}

}  // namespace

ReportSection heatmap_section(const ReportSubject& subject) {
  ReportSection section{"noise", "Under sensor noise", {}};
  const noise::NoiseGridConfig& noise = subject.experiment.noise;
  const std::vector<std::string>& simulators = subject.experiment.simulators;
  // The other grid's diagonal may have levels that this one does not have.
  const Rows alike = rows_that(
      [&](const experiments::CellSummary& row) { return is_among(noise.torque, row.cell.torque); },
      subject.summary.cells);
  const NoiseGrid torque_grid{
      {&noise::NoiseCell::accelerometer, "accelerometer noise (m/s²)", "m/s²",
       "accelerometer noise"},
      {&noise::NoiseCell::torque, "torque noise (N·m)", "N·m", "torque noise"}};
  if (levels(alike, torque_grid.x).size() * levels(alike, torque_grid.y).size() > 1) {
    section.html += grid_html(alike, torque_grid, simulators, "estimator");
  }
  const noise::KneeWheelGridConfig& joints = noise.knee_wheel;
  const Rows apart = rows_that(
      [&](const experiments::CellSummary& row) {
        return row.cell.accelerometer == joints.accelerometer &&
               is_among(joints.knee, row.cell.knee) && is_among(joints.wheel, row.cell.wheel);
      },
      subject.summary.cells);
  if (std::any_of(apart.begin(), apart.end(), [](const experiments::CellSummary& row) {
        return row.cell.knee != row.cell.wheel;
      })) {
    section.html +=
        fmt::format("<h3>Knees and wheels apart</h3>\n<p>Accelerometer noise {:.4g} m/s².</p>\n",
                    joints.accelerometer);
    section.html +=
        grid_html(apart,
                  {{&noise::NoiseCell::wheel, "wheel torque noise (N·m)", "N·m", "wheel noise"},
                   {&noise::NoiseCell::knee, "knee torque noise (N·m)", "N·m", "knee noise"}},
                  simulators, "estimator-apart");
  }
  return section;
}

}  // namespace touchdown::render
