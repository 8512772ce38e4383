#include "render/gnuplot/facet_script.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "render/gnuplot/figure.hpp"
#include "render/palette.hpp"

namespace touchdown::render {

namespace {

std::vector<std::string> encoded(const std::vector<std::string>& cells) {
  std::vector<std::string> texts;
  std::transform(cells.begin(), cells.end(), std::back_inserter(texts), percent_encoded);
  return texts;
}

using experiments::FigureAxis;
using experiments::FigureSpec;
using experiments::MarkShape;

/// A column's value as the axis draws it.
std::string value_text(const FigureAxis& axis, const std::string& column) {
  std::string text = fmt::format("column({})", gnuplot_text(column));
  if (axis.factor != 1.0) text = fmt::format("{}*{}", axis.factor, text);
  if (axis.offset != 0.0) text = fmt::format("{}+{}", axis.offset, text);
  return axis.floor ? fmt::format("at_least({}, {})", text, *axis.floor) : text;
}

/// The plotting style of a measure's marks, with bars for its intervals.
std::string shape_text(MarkShape shape, bool has_rows, bool has_interval) {
  if (is_highlight(shape)) return "points";
  if (has_rows) return has_interval ? "xerrorbars" : "points";
  if (shape == MarkShape::points) return has_interval ? "yerrorbars" : "points";
  return has_interval ? "yerrorlines" : "linespoints";
}

constexpr std::size_t most_columns = 4;

constexpr double title_height = 26.0, axis_height = 58.0, tics_height = 28.0, line_gap = 14.0;

constexpr double axis_width = 68.0, column_gap = 30.0, key_line = 17.0;

constexpr double right_margin = 24.0;

constexpr double narrowest = 600.0;  ///< the caption needs this width

/// Panels beside and below each other. A folded line of panels continues in the next one.
struct Grid {
  std::size_t columns = 1, lines = 1;
  bool is_folded = false;
};

double margin_of(const FacetShape& shape) { return shape.rows > 0 ? shape.row_names : axis_width; }

Grid grid_of(const FacetShape& shape) {
  const std::size_t most = columns_in(shape.room, margin_of(shape) + right_margin,
                                      {shape.panels * shape.measures, 330.0, column_gap})
                               .count;
  if (shape.measures == 1) {
    const std::size_t fitting = std::min(most, most_columns);
    const std::size_t lines = (shape.panels + fitting - 1) / fitting;
    return {(shape.panels + lines - 1) / lines, lines};
  }
  Grid grid =
      shape.rows > 0 ? Grid{shape.measures, shape.panels} : Grid{shape.panels, shape.measures};
  if (grid.columns <= most) return grid;
  // Curves of different measures do not share a vertical axis.
  const std::size_t columns = shape.rows > 0 ? most : 1;
  return {columns, (shape.panels * shape.measures + columns - 1) / columns, true};
}

double panel_width(const FacetShape& shape, const Grid& grid) {
  const auto columns = static_cast<double>(grid.columns);
  return columns_in(shape.room, margin_of(shape) + right_margin,
                    {grid.columns, std::clamp(960.0 / columns, 225.0, 330.0), column_gap}, 0.0)
      .width;
}

double panel_height(const FacetShape& shape, const Grid& grid, double panel_width) {
  if (shape.rows > 0) {
    const double row = std::max(27.0, 9.0 + 9.0 * static_cast<double>(shape.series));
    return row * static_cast<double>(shape.rows);
  }
  return (grid.lines == 1 ? 1.0 : 0.7) * panel_width;
}

}  // namespace

std::vector<FacetRow> facet_rows(const experiments::FigureSpec& spec, const Table& table) {
  std::vector<FacetRow> rows;
  experiments::FigureAxis order = spec.x;
  order.floor.reset();  // values that are drawn at one place keep their order
  for (const TableRow& cells : table.all()) {
    const auto panel = experiments::group_of(spec.panels, cells);
    const auto series = experiments::group_of(spec.series, cells);
    const auto row = experiments::group_of(spec.rows, cells);
    const auto mark = std::find_if(
        spec.marks.begin(), spec.marks.end(),
        [&](const experiments::FigureMark& m) { return experiments::passes(cells, m.where); });
    const bool is_drawn = experiments::passes(cells, spec.where) && panel && series && row &&
                          mark != spec.marks.end();
    if (!is_drawn) continue;
    FacetRow drawn{cells, *panel, *series, *row,
                   static_cast<std::size_t>(mark - spec.marks.begin())};
    if (spec.rows.columns.empty()) drawn.x = experiments::drawn_value(order, cells);
    if (!std::isnan(drawn.x)) rows.push_back(drawn);
  }
  std::stable_sort(rows.begin(), rows.end(), [](const FacetRow& a, const FacetRow& b) {
    return std::tie(a.panel, a.series, a.mark, a.row, a.x) <
           std::tie(b.panel, b.series, b.mark, b.row, b.x);
  });
  return rows;
}

std::string data_file(const Table& table, const std::vector<FacetRow>& rows) {
  // Not `to_csv`, which marks names that spreadsheets would compute: gnuplot compares the names.
  std::string text;
  for (const Column& column : table.columns) {
    text += fmt::format("{}{}", text.empty() ? "" : ",", percent_encoded(column.name));
  }
  text += '\n';
  for (const FacetRow& row : rows) {
    text += fmt::format("{}\n", fmt::join(encoded(row.cells.texts()), ","));
  }
  return text;
}

std::string percent_encoded(const std::string& text) {
  // gnuplot cuts a quoted cell at a comma and at a quote, reads escapes such as \n, and skips a
  // line that begins with #.
  constexpr std::string_view special = "%\",\\#";
  std::string result;
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    if (byte < 0x20 || special.find(letter) != std::string_view::npos) {
      result += fmt::format("%{:02X}", byte);
    } else {
      result += letter;
    }
  }
  return result;
}

std::string condition_of(const std::vector<experiments::CellFilter>& where) {
  std::string text;
  for (const experiments::CellFilter& filter : where) {
    text += fmt::format("{}strcol({}) eq {}", text.empty() ? "" : " && ",
                        gnuplot_text(filter.column), gnuplot_text(percent_encoded(filter.value)));
  }
  return text;
}

std::string condition_of(const experiments::FigureGroups& groups, std::size_t group) {
  std::vector<experiments::CellFilter> where;
  for (std::size_t i = 0; i < groups.columns.size(); ++i) {
    where.push_back({groups.columns[i], groups.groups[group].values[i]});
  }
  return condition_of(where);
}

std::string selection(const char* name, std::size_t place, const std::string& condition) {
  if (condition.empty()) return {};
  return fmt::format("{}{}(v) = {} ? v : NaN\n", name, place + 1, condition);
}

std::string label(const FigureAxis& axis) {
  return axis.unit.empty() ? axis.title : fmt::format("{} ({})", axis.title, axis.unit);
}

std::string series_style(const FigureSpec& spec, std::size_t series) {
  if (spec.series.columns.empty()) return "lt 1";
  const std::string& name = spec.series.groups[series].values.front();
  if (name == "truth") return fmt::format("lc rgb '#{:06x}' lw 2.4 dt 1 pt 7", truth_colour);
  if (name == "always" || name == "always_contact") {
    return fmt::format("lc rgb '#{:06x}' lw 2.4 dt 2 pt 6", always_contact_colour);
  }
  return fmt::format("lt {}", spec.colour_order.empty() ? series % line_colours.size() + 1
                                                        : line_type_of(spec.colour_order, name));
}

const char* key_shape(const FigureSpec& spec) {
  const bool has_curve = spec.rows.columns.empty() &&
                         std::any_of(spec.marks.begin(), spec.marks.end(), [](const auto& mark) {
                           return mark.shape == MarkShape::curve;
                         });
  return has_curve ? "linespoints" : "points";
}

bool is_highlight(MarkShape shape) { return shape == MarkShape::ring || shape == MarkShape::cross; }

std::string plot_command(const FigureSpec& spec, const FigureAxis& measure, MarkShape shape,
                         const std::string& file, const FacetPlot& plot) {
  const bool has_rows = !spec.rows.columns.empty();
  const bool has_interval = !measure.low.empty() && !is_highlight(shape);
  const bool is_placed = has_rows || spec.x.scale == experiments::AxisScale::ordinal;
  const std::string position = fmt::format(
      "{}{:+.6g}", is_placed ? "place(0)" : value_text(spec.x, spec.x.column), plot.aside);
  const std::string value = value_text(measure, measure.column);
  std::string first = has_rows ? value : position;
  for (const std::string& name : plot.selections) first = fmt::format("{}({})", name, first);
  std::string columns = fmt::format("({}):({})", first, has_rows ? position : value);
  if (has_interval) {
    columns += fmt::format(":({}):({})", value_text(measure, measure.low),
                           value_text(measure, measure.high));
  }
  return fmt::format("{} using {} with {} {}{} notitle", file, columns,
                     shape_text(shape, has_rows, has_interval), plot.style,
                     shape == MarkShape::ring    ? " pt 6 ps 1.6 lw 2"
                     : shape == MarkShape::cross ? " pt 2 ps 1.3 lw 1.6"
                                                 : "");
}

FacetLayout facet_layout(const FacetShape& shape) {
  const Grid grid = grid_of(shape);
  const bool by_measure = shape.measures > 1;
  const double margin = margin_of(shape);
  FacetLayout layout;
  layout.panel_width = panel_width(shape, grid);
  layout.panel_height = panel_height(shape, grid, layout.panel_width);
  double top = 0.0;
  for (std::size_t line = 0; line < grid.lines; ++line) {
    const bool titled =
        shape.has_titles && (!by_measure || shape.rows > 0 || grid.is_folded || line == 0);
    const bool is_last = line + 1 == grid.lines;
    top += titled ? title_height : 4.0;
    bool any_x = false;
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const std::size_t place = line * grid.columns + column;
      FacetPanel panel;
      if (place >= shape.panels * shape.measures) break;
      panel.panel = shape.rows > 0 ? place / shape.measures : place % shape.panels;
      panel.measure = shape.rows > 0 ? place % shape.measures : place / shape.panels;
      const bool is_lowest =
          is_last || grid.is_folded || (!by_measure && place + grid.columns >= shape.panels);
      panel.left = margin + static_cast<double>(column) * (layout.panel_width + column_gap);
      panel.top = top;
      panel.has_title = titled;
      panel.has_x_title = is_lowest;
      panel.has_x_tics = is_lowest || shape.rows > 0 || (shape.is_own_x && !by_measure);
      panel.is_leftmost = column == 0;
      any_x = any_x || panel.has_x_tics;
      layout.panels.push_back(panel);
    }
    top += layout.panel_height +
           (any_x ? (is_last || grid.is_folded ? axis_height : tics_height) : line_gap);
  }
  const double columns = static_cast<double>(grid.columns);
  layout.key_left = margin + columns * layout.panel_width + (columns - 1.0) * column_gap + 16.0;
  layout.key_top = layout.panels.front().top;
  if (layout.key_left + shape.key > shape.room) {  // the key is below the panels
    layout.key_left = margin;
    layout.key_top = top;
    layout.width = margin + columns * (layout.panel_width + column_gap) - column_gap + right_margin;
  }
  layout.width =
      std::max({std::min(narrowest, shape.room), layout.width, layout.key_left + shape.key});
  layout.height =
      std::max(top, layout.key_top + key_line * static_cast<double>(shape.series) + axis_height);
  return layout;
}

}  // namespace touchdown::render
