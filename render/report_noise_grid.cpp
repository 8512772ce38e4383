#include "render/report_noise_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "render/html.hpp"
#include "render/report_heatmap.hpp"
#include "render/report_parts.hpp"

namespace touchdown {
namespace {

std::string says(const TableRow& row, const NoiseGrid& grid) {
  std::string text = fmt::format(
      "{}, {}: {} {:.4g} {}, {} {:.4g} {}: success rate {}", engine_title(row.text("simulator")),
      estimator_title(row.text("estimator")), grid.y_name, row.number(grid.y_column), grid.y_unit,
      grid.x_name, row.number(grid.x_column), grid.x_unit, with_interval(row.interval("success")));
  const double to_beat = row.number("always_contact_success");
  if (std::isfinite(to_beat)) text += fmt::format("; always contact {:.3f}", to_beat);
  return text;
}

ReportMap map_of(const std::vector<TableRow>& rows, const NoiseGrid& grid, double low) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  ReportMap map{.title = {},
                .x_label = grid.x_label,
                .y_label = grid.y_label,
                .x = noise_levels(rows, grid.x_column),
                .y = noise_levels(rows, grid.y_column),
                .cells = {},
                .low = low,
                .high = 1.0,
                .iso_levels = {0.90, 0.95, 0.98}};
  map.cells.assign(map.y.size(),
                   std::vector<MapCell>(map.x.size(), {nan, nan, "not part of this study"}));
  for (const TableRow& row : rows) {
    const auto c = std::find(map.x.begin(), map.x.end(), row.number(grid.x_column));
    const auto r = std::find(map.y.begin(), map.y.end(), row.number(grid.y_column));
    if (c == map.x.end() || r == map.y.end()) continue;
    map.cells[static_cast<std::size_t>(r - map.y.begin())]
             [static_cast<std::size_t>(c - map.x.begin())] = {
        row.number("success"), row.number("always_contact_success"), says(row, grid)};
  }
  return map;
}

std::vector<std::string> distinct(const std::vector<TableRow>& rows, const std::string& column) {
  std::vector<std::string> values;
  for (const TableRow& row : rows) {
    if (std::find(values.begin(), values.end(), row.text(column)) == values.end()) {
      values.push_back(row.text(column));
    }
  }
  return values;
}

}  // namespace

std::vector<double> noise_levels(const std::vector<TableRow>& rows, const std::string& column) {
  std::set<double> values;
  for (const TableRow& row : rows) {
    if (std::isfinite(row.number(column))) values.insert(row.number(column));
  }
  return {values.begin(), values.end()};
}

std::string grid_html(const std::vector<TableRow>& rows, const NoiseGrid& grid,
                      const std::string& name) {
  // Below what a constant answer earns, how bad it is does not matter: keep the colours for above.
  double least = 1.0, constant = 1.0;
  for (const TableRow& row : rows) {
    least = std::fmin(least, row.number("success"));
    constant = std::fmin(constant, row.number("always_contact_success"));
  }
  if (constant < 1.0) least = std::max(least, constant);
  const double low = std::floor(least * 20.0 - 1e-9) / 20.0;
  const bool fine = noise_levels(rows, grid.x_column).size() > 8;
  std::string choice = "<fieldset class=\"choice\"><legend>Estimator</legend>\n",
              maps = fmt::format("<div class=\"maps{}\">\n", fine ? " fine" : "");
  bool first = true;
  for (const std::string& estimator : distinct(rows, "estimator")) {
    if (estimator == "always_contact") continue;
    const std::string title = estimator_title(estimator);
    choice += fmt::format("<label><input type=\"radio\" name=\"{}\" value=\"{}\"{}>{}</label>\n",
                          name, escaped(estimator), first ? " checked" : "", escaped(title));
    first = false;
    for (const std::string& simulator : distinct(rows, "simulator")) {
      std::vector<TableRow> own;
      std::copy_if(rows.begin(), rows.end(), std::back_inserter(own), [&](const TableRow& row) {
        return row.text("estimator") == estimator && row.text("simulator") == simulator;
      });
      if (own.empty()) continue;
      ReportMap map = map_of(own, grid, low);
      map.title = fmt::format("{}, {}: success rate", title, engine_title(simulator));
      maps += fmt::format(
          "<figure data-estimator=\"{}\"><figcaption>{}: {}</figcaption>\n{}</figure>\n",
          escaped(estimator), escaped(engine_title(simulator)), escaped(title), map_svg(map));
    }
  }
  return fmt::format(
      "<div class=\"heatmaps\">\n{}</fieldset>\n<p class=\"readout\" aria-live=\"polite\">Point at "
      "a "
      "cell, tap it, or use the arrow keys: its numbers appear here.</p>\n{}</div>\n<p "
      "class=\"note\">Colours run from {:.2f} and less (dark) to 1 (light). Lines: success rates "
      "of 0.90, "
      "0.95 "
      "and 0.98. A struck-out cell does no better than always saying “contact”. The same numbers "
      "are in the table “Success” below.</p>\n</div>\n",
      choice, maps, low);
}

}  // namespace touchdown
