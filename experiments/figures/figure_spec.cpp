#include "experiments/figures/figure_spec.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/rows.hpp"

namespace touchdown::experiments {

namespace {

std::vector<std::string> values_of(const std::vector<std::string>& columns, const TableRow& row) {
  std::vector<std::string> values;
  for (const std::string& column : columns) values.push_back(row.text(column));
  return values;
}

std::string with_unit(std::string value, const FigureAxis& axis) {
  return axis.unit.empty() ? value : fmt::format("{} {}", value, axis.unit);
}

/// The values of the rows of one panel and series, with their place on the other axis:
/// "0.75 at 0.5 m, 0.5 at 0.7 m".
std::string series_text(const FigureSpec& spec, const Table& table, std::size_t panel,
                        std::size_t series) {
  const FigureAxis& measure = spec.measures.front();
  std::string text;
  for (const TableRow& row : table.all()) {
    const bool is_drawn = passes(row, spec.where) && group_of(spec.panels, row) == panel &&
                          group_of(spec.series, row) == series;
    const std::optional<std::size_t> place = group_of(spec.rows, row);
    const double value = drawn_value(measure, row);
    if (!is_drawn || !place || std::isnan(value)) continue;
    const std::string at = spec.rows.columns.empty()
                               ? "at " + with_unit(row.text(spec.x.column), spec.x)
                               : "for " + spec.rows.groups[*place].title;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ",
                        with_unit(fmt::format("{:.4g}", value), measure), at);
  }
  return text;
}

std::size_t count_of(const FigureGroups& groups) {
  return groups.columns.empty() ? 1 : groups.groups.size();
}

std::string title_of(const FigureGroups& groups, std::size_t place) {
  return groups.columns.empty() ? "" : groups.groups[place].title;
}

}  // namespace

bool passes(const TableRow& row, const std::vector<CellFilter>& where) {
  return std::ranges::all_of(
      where, [&](const CellFilter& filter) { return row.text(filter.column) == filter.value; });
}

std::optional<std::size_t> group_of(const FigureGroups& groups, const TableRow& row) {
  if (groups.columns.empty()) return 0;
  const std::vector<std::string> values = values_of(groups.columns, row);
  const auto found = std::ranges::find(groups.groups, values, &FigureGroup::values);
  if (found == groups.groups.end()) return {};
  return static_cast<std::size_t>(found - groups.groups.begin());
}

FigureGroups groups_in(const Table& table, const std::string& column,
                       const std::function<std::string(const std::string& value)>& title,
                       const std::vector<CellFilter>& where) {
  return combinations_in(
      table, {column}, [&](const auto& values) { return title(values.front()); }, where);
}

FigureGroups combinations_in(
    const Table& table, const std::vector<std::string>& columns,
    const std::function<std::string(const std::vector<std::string>& values)>& title,
    const std::vector<CellFilter>& filters) {
  const auto rows = where(table.all(), [&](const TableRow& row) { return passes(row, filters); });
  FigureGroups groups{columns, {}};
  for (const auto& values :
       unique(rows, [&](const TableRow& row) { return values_of(columns, row); })) {
    groups.groups.push_back({values, title(values)});
  }
  return groups;
}

FigureGroups noise_panels(const Table& table) {
  return combinations_in(
      table, {"torque_noise_nm", "accelerometer_noise_mps2"},
      [](const auto& noise) { return fmt::format("{} N·m, {} m/s²", noise[0], noise[1]); });
}

FigureAxis axis_with_interval(const std::string& column, const std::string& title) {
  return {.column = column, .title = title, .low = column + "_low", .high = column + "_high"};
}

double drawn_value(const FigureAxis& axis, const TableRow& row, const std::string& column) {
  const double value = axis.offset + axis.factor * row.number(column);
  return axis.floor && value < *axis.floor ? *axis.floor : value;
}

std::string values_text(const FigureSpec& spec, const Table& table) {
  std::string text;
  for (std::size_t panel = 0; panel < count_of(spec.panels); ++panel) {
    std::string of_panel;
    for (std::size_t series = 0; series < count_of(spec.series); ++series) {
      const std::string values = series_text(spec, table, panel, series);
      if (values.empty()) continue;
      const std::string name = title_of(spec.series, series);
      of_panel += fmt::format("{} {}{}{}", of_panel.empty() ? "" : ";", name,
                              name.empty() ? "" : ": ", values);
    }
    if (of_panel.empty()) continue;
    const std::string name = title_of(spec.panels, panel);
    text +=
        fmt::format("{}{}{}.", name.empty() ? "" : " ", name.empty() ? "" : name + ",", of_panel);
  }
  return text;
}

}  // namespace touchdown::experiments
