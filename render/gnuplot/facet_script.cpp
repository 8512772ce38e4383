#include "render/gnuplot/facet_script.hpp"

#include <algorithm>
#include <array>
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
  if (shape == MarkShape::step) return "steps";
  if (shape == MarkShape::line) return "lines";
  if (has_rows) return has_interval ? "xerrorbars" : "points";
  if (shape == MarkShape::points) return has_interval ? "yerrorbars" : "points";
  return has_interval ? "yerrorlines" : "linespoints";
}

/// The expression within these functions, of which each is NaN in the rows of others.
std::string selected(std::string expression, const std::vector<std::string>& selections) {
  for (const std::string& name : selections) expression = fmt::format("{}({})", name, expression);
  return expression;
}

/// The text of a percentage in a cell.
std::string percent_text(const FigureAxis& measure, const std::string& column) {
  return fmt::format("(strcol({}) eq 'nan' ? '–' : sprintf('%.2f', {}))", gnuplot_text(column),
                     value_text(measure, column));
}

constexpr std::size_t most_columns = 4, most_images = 3;

constexpr double title_height = 26.0, axis_height = 58.0, tics_height = 28.0, line_gap = 14.0;

constexpr double axis_width = 68.0, column_gap = 30.0, key_gap = 16.0, key_line = 17.0;

constexpr double right_margin = 24.0;

constexpr double narrowest = 600.0;  ///< the caption needs this width

/// Panels beside and below each other. A folded line of panels continues in the next one.
struct Grid {
  std::size_t columns = 1, lines = 1;
  bool is_folded = false;
};

bool is_image(const FacetShape& shape) { return shape.cells.columns > 0; }

double margin_of(const FacetShape& shape) {
  return shape.row_names > 0.0 ? shape.row_names : axis_width;
}

Grid grid_of(const FacetShape& shape) {
  const double margins = margin_of(shape) + (is_image(shape) ? key_gap + shape.key : right_margin);
  const double width = is_image(shape) ? shape.cells.panel_width() : 330.0;
  const std::size_t most =
      columns_in(shape.room, margins, {shape.panels * shape.measures, width, column_gap},
                 is_image(shape) ? width : 190.0)
          .count;
  if (shape.measures == 1) {
    const std::size_t fitting = std::min(most, is_image(shape) ? most_images : most_columns);
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
  if (is_image(shape)) return shape.cells.panel_width();
  const auto columns = static_cast<double>(grid.columns);
  const double most = shape.is_wide ? 860.0 : 330.0;
  return columns_in(shape.room, margin_of(shape) + right_margin,
                    {grid.columns, std::clamp(960.0 / columns, 225.0, most), column_gap}, 0.0)
      .width;
}

double panel_height(const FacetShape& shape, const Grid& grid, double panel_width) {
  if (is_image(shape)) return shape.cells.panel_height();
  if (shape.rows > 0) {
    const double row = std::max(27.0, 9.0 + 9.0 * static_cast<double>(shape.series));
    return row * static_cast<double>(shape.rows);
  }
  if (shape.is_wide) return 160.0;
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
    const bool has_y = spec.y.column.empty() || !std::isnan(cells.number(spec.y.column));
    FacetRow drawn{cells, *panel, *series, *row,
                   static_cast<std::size_t>(mark - spec.marks.begin())};
    if (spec.rows.columns.empty()) drawn.x = experiments::drawn_value(order, cells);
    if (has_y && !std::isnan(drawn.x)) rows.push_back(drawn);
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
  for (const experiments::FigureMark& mark : spec.marks) {
    if (!spec.rows.columns.empty()) break;
    if (mark.shape == MarkShape::curve) return "linespoints";
    if (mark.shape == MarkShape::step || mark.shape == MarkShape::line) return "lines";
  }
  return "points";
}

bool is_highlight(MarkShape shape) { return shape == MarkShape::ring || shape == MarkShape::cross; }

ImageCells image_cells(std::size_t columns, std::size_t rows, bool has_intervals, double room) {
  using Content = ImageCells::Content;
  constexpr std::size_t most_numbered = 64;
  // A panel of few cells is as large as its title and labels need.
  constexpr double narrowest = 330.0, lowest = 250.0;
  constexpr std::array<std::array<double, 2>, 3> least = {
      {{26.0, 22.0}, {60.0, 44.0}, {104.0, 54.0}}};
  ImageCells cells{.columns = columns, .rows = rows};
  for (const Content content : {Content::interval, Content::number, Content::colour}) {
    const auto& [width, height] = least[static_cast<std::size_t>(content)];
    cells.content = content;
    cells.width = std::max(width, narrowest / static_cast<double>(columns));
    cells.height = std::max(height, lowest / static_cast<double>(rows));
    const double needed = axis_width + static_cast<double>(columns) * width + key_gap + scale_width;
    const bool is_written = columns * rows <= most_numbered && needed <= room;
    if (is_written && (has_intervals || content == Content::number)) break;
  }
  return cells;
}

std::string image_style() {
  std::string stops, tics;
  for (std::size_t i = 0; i < viridis.size(); ++i) {
    stops += fmt::format("{}{} '#{:06x}'", i == 0 ? "" : ", ", i, viridis[i]);
  }
  for (const int tic : {90, 95, 98, 99}) tics += fmt::format(", '{0}' shade({0})", tic);
  return fmt::format(
      "unset grid\nset border 0\nset tics scale 0\nset palette defined ({2})\n"
      "shade(v) = -log10(100 - (v < {0} ? {0} : v > {1} ? {1} : v))\n"
      "set cbrange [shade({0}):shade({1})]\nset cbtics ('≤ {0}' shade({0}), '≥ {1}' "
      "shade({1}){3})\n",
      lowest_shade, highest_shade, stops, tics);
}

std::string image_plot(MarkShape shape, ImageCells::Content content, const std::string& file,
                       const std::vector<std::string>& selections, const FigureAxis& measure) {
  using Content = ImageCells::Content;
  const std::string x = selected("xplace(0)", selections);
  const std::string value = value_text(measure, measure.column);
  if (shape == MarkShape::image) {
    return fmt::format(
        "{} using ({}):(yplace(0)):(0.5):(0.5):(shade({})) with boxxyerror fillcolor palette "
        "notitle",
        file, x, value);
  }
  if (shape == MarkShape::number && content == Content::colour) return {};
  if (shape == MarkShape::number) {
    std::string text = percent_text(measure, measure.column);
    if (content == Content::interval) {
      text +=
          fmt::format(".(strcol({}) eq 'nan' ? '' : \"\\n\".{}.'–'.{})", gnuplot_text(measure.low),
                      percent_text(measure, measure.low), percent_text(measure, measure.high));
    }
    // Around this value, white and black letters have the same contrast with the colour.
    constexpr double dark_letters_from = 97.523;
    return fmt::format(
        "{} using ({}):(yplace(0)):({}):(strcol({}) ne 'nan' && {} < {} ? 0xffffff : 0x101418) "
        "with labels font ',8.5' textcolor rgb variable notitle",
        file, x, text, gnuplot_text(measure.column), value, dark_letters_from);
  }
  // With a number a cross is the outer thirds of both diagonals, which spare the number. With the
  // colour alone it is in the middle, as ends would meet at the corners.
  const bool has_number = content != Content::colour;
  const double from = has_number ? 0.5 : 0.275, to = has_number ? 0.32 : 0.0;
  std::string text;
  for (const char* style : {"lw 3.4 lc rgb '#101418'", "lw 1.4 lc rgb '#ffffff'"}) {
    text += fmt::format(
        "{}for [i=-1:1:2] for [j=-1:1:2] {} using ({}+i*{}):(yplace(0)+j*{}):(i*{}):(j*{}) with "
        "vectors nohead {} dt 1 notitle",
        text.empty() ? "" : ", ", file, x, from, from, to - from, to - from, style);
  }
  return text;
}

std::string plot_command(const FigureSpec& spec, const FigureAxis& measure, MarkShape shape,
                         const std::string& file, const FacetPlot& plot) {
  const bool has_rows = !spec.rows.columns.empty();
  const bool is_ordinal = spec.x.scale == experiments::AxisScale::ordinal;
  const bool has_interval =
      !measure.low.empty() && !is_highlight(shape) && shape != MarkShape::step;
  const std::string position = fmt::format("{}{:+.6g}",
                                           has_rows     ? "place(0)"
                                           : is_ordinal ? "xplace(0)"
                                                        : value_text(spec.x, spec.x.column),
                                           plot.aside);
  const std::string value = value_text(measure, measure.column);
  std::string columns =
      fmt::format("({}):({})", selected(has_rows ? value : position, plot.selections),
                  has_rows ? position : value);
  if (has_interval) {
    // A value without an interval is drawn, too: with ends at the value itself.
    for (const std::string& end : {measure.low, measure.high}) {
      columns += fmt::format(":(strcol({}) eq 'nan' ? {} : {})", gnuplot_text(end), value,
                             value_text(measure, end));
    }
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
  layout.key_left = margin + columns * layout.panel_width + (columns - 1.0) * column_gap + key_gap;
  layout.key_top = layout.panels.front().top;
  if (!is_image(shape) &&
      layout.key_left + shape.key > shape.room) {  // the key is below the panels
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
