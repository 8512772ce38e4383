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

/// Rings and crosses are drawn around and over other marks, without intervals.
bool is_highlight(MarkShape shape) { return shape == MarkShape::ring || shape == MarkShape::cross; }

/// The plotting style of a measure's marks, with bars for its intervals.
std::string shape_text(MarkShape shape, bool has_rows, bool has_interval) {
  if (is_highlight(shape)) return "points";
  if (has_rows) return has_interval ? "xerrorbars" : "points";
  if (shape == MarkShape::points) return has_interval ? "yerrorbars" : "points";
  return has_interval ? "yerrorlines" : "linespoints";
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

}  // namespace touchdown::render
