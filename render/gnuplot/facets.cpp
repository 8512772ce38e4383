#include "render/gnuplot/facets.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "render/gnuplot/facet_script.hpp"
#include "render/gnuplot/frame.hpp"

namespace touchdown::render {

namespace {

/// What a layout depends on: numbers of drawn groups and measures, and widths of texts (px).
struct FacetShape {
  std::size_t panels = 1, measures = 1, series = 1;
  std::size_t rows = 0;  ///< 0: curves over x
  bool has_titles = false;
  bool is_own_x = false;  ///< each panel has its own values of x
  double row_names = 0.0, key = 0.0;
};

/// The position of one panel (px), and the labels around it.
struct FacetPanel {
  std::size_t panel = 0, measure = 0;
  double left = 0.0, top = 0.0;
  bool has_title = false;
  bool has_x_tics = false, has_x_title = false;
  bool is_leftmost = false;  ///< has the names of rows, or the labels of the vertical axis
};

/// Panels in lines of at most four. With several measures, each has a line of its own, or with
/// `rows` a column of its own.
struct FacetLayout {
  std::vector<FacetPanel> panels;
  double panel_width = 0.0, panel_height = 0.0;
  double width = 0.0, height = 0.0;
  double key_left = 0.0, key_top = 0.0;
};

constexpr std::size_t most_columns = 4;

constexpr double title_height = 26.0, axis_height = 58.0, tics_height = 28.0, line_gap = 14.0;

constexpr double axis_width = 68.0, column_gap = 30.0, key_line = 17.0;

constexpr double narrowest = 600.0;  ///< the caption needs this width

/// Numbers of panels beside and below each other.
struct Grid {
  std::size_t columns = 1, lines = 1;
};

Grid grid_of(const FacetShape& shape) {
  if (shape.measures == 1) {
    const std::size_t lines = (shape.panels + most_columns - 1) / most_columns;
    return {(shape.panels + lines - 1) / lines, lines};
  }
  return shape.rows > 0 ? Grid{shape.measures, shape.panels} : Grid{shape.panels, shape.measures};
}

double panel_width(const Grid& grid) {
  return std::clamp(960.0 / static_cast<double>(grid.columns), 225.0, 330.0);
}

double panel_height(const FacetShape& shape, const Grid& grid) {
  if (shape.rows > 0) {
    const double row = std::max(27.0, 9.0 + 9.0 * static_cast<double>(shape.series));
    return row * static_cast<double>(shape.rows);
  }
  return (grid.lines == 1 ? 1.0 : 0.7) * panel_width(grid);
}

FacetLayout facet_layout(const FacetShape& shape) {
  const Grid grid = grid_of(shape);
  const bool by_measure = shape.measures > 1;
  const double margin = shape.rows > 0 ? shape.row_names : axis_width;
  FacetLayout layout;
  layout.panel_width = panel_width(grid);
  layout.panel_height = panel_height(shape, grid);
  double top = 0.0;
  for (std::size_t line = 0; line < grid.lines; ++line) {
    const bool titled = shape.has_titles && (!by_measure || shape.rows > 0 || line == 0);
    const bool is_last = line + 1 == grid.lines;
    top += titled ? title_height : 4.0;
    bool any_x = false;
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const std::size_t place = line * grid.columns + column;
      FacetPanel panel;
      panel.panel = by_measure ? (shape.rows > 0 ? line : column) : place;
      panel.measure = by_measure ? (shape.rows > 0 ? column : line) : 0;
      if (panel.panel >= shape.panels) break;
      const bool is_lowest = is_last || (!by_measure && place + grid.columns >= shape.panels);
      panel.left = margin + static_cast<double>(column) * (layout.panel_width + column_gap);
      panel.top = top;
      panel.has_title = titled;
      panel.has_x_title = is_lowest;
      panel.has_x_tics = is_lowest || shape.rows > 0 || (shape.is_own_x && !by_measure);
      panel.is_leftmost = column == 0;
      any_x = any_x || panel.has_x_tics;
      layout.panels.push_back(panel);
    }
    top += layout.panel_height + (any_x ? (is_last ? axis_height : tics_height) : line_gap);
  }
  const double columns = static_cast<double>(grid.columns);
  layout.key_left = margin + columns * layout.panel_width + (columns - 1.0) * column_gap + 16.0;
  layout.key_top = layout.panels.front().top;
  layout.width = std::max(narrowest, layout.key_left + shape.key);
  layout.height =
      std::max(top, layout.key_top + key_line * static_cast<double>(shape.series) + axis_height);
  return layout;
}

using experiments::AxisScale;
using experiments::FigureAxis;
using experiments::FigureGroups;
using experiments::FigureSpec;

constexpr double letter_width = 6.6;  ///< of titles of series and rows, on average (px)

/// The places of groups with drawn rows.
std::vector<std::size_t> used(const std::vector<FacetRow>& rows, std::size_t FacetRow::*place) {
  std::set<std::size_t> places;
  for (const FacetRow& row : rows) places.insert(row.*place);
  return {places.begin(), places.end()};
}

std::string title_of(const FigureGroups& groups, std::size_t place) {
  return groups.columns.empty() ? "" : groups.groups[place].title;
}

double widest(const FigureGroups& groups, const std::vector<std::size_t>& places) {
  std::size_t letters = 0;
  for (const std::size_t place : places)
    letters = std::max(letters, width(title_of(groups, place)));
  return letter_width * static_cast<double>(letters);
}

struct Range {
  double from = HUGE_VAL, to = -HUGE_VAL;

  void include(double value) {
    if (!std::isfinite(value)) return;
    from = std::min(from, value);
    to = std::max(to, value);
  }
};

/// The range with a margin around the values, and the ends that the figure prescribes.
Range with_margin(Range range, const FigureAxis& axis) {
  if (range.from > range.to) range = {1.0, 1.0};
  if (axis.scale == AxisScale::log) {
    range = {0.8 * range.from, 1.25 * range.to};
  } else {
    const double span = range.to - range.from;
    const double margin = span > 0.0 ? 0.06 * span : std::max(0.5 * std::abs(range.from), 0.5);
    range = {range.from - margin, range.to + margin};
  }
  return {axis.from.value_or(range.from), axis.to.value_or(range.to)};
}

/// One figure: the drawn groups, and the commands of its panels.
class FacetFigure {
 public:
  FacetFigure(const FigureSpec& spec, const Table& table, const std::filesystem::path& stem)
      : spec_(spec),
        table_(table),
        data_(facet_rows(spec, table)),
        file_(gnuplot_file(stem.filename().string() + ".dat")),
        panels_(used(data_, &FacetRow::panel)),
        series_(used(data_, &FacetRow::series)),
        rows_(has_rows() ? used(data_, &FacetRow::row) : std::vector<std::size_t>()) {
    for (const FigureAxis& measure : spec.measures) {
      const bool has_values = std::any_of(data_.begin(), data_.end(), [&](const FacetRow& row) {
        return !std::isnan(experiments::drawn_value(measure, row.cells));
      });
      if (has_values) measures_.push_back(&measure);
    }
  }

  bool is_empty() const { return measures_.empty(); }

  Figure draw(const std::filesystem::path& stem) const {
    const FacetLayout layout = facet_layout(shape());
    const FigureFrame frame(spec_.title, spec_.caption, layout.width, layout.height);
    std::string commands = head();
    for (const FacetPanel& panel : layout.panels) {
      commands += frame.panel(panel.left, panel.top, layout.panel_width, layout.panel_height);
      commands += axes_of(panel, layout);
      const bool has_key = &panel == &layout.panels.front() && series_.size() > 1;
      commands += has_key ? frame.key(layout.key_left, layout.key_top - 6.0) : "unset key\n";
      commands += "plot " + plots_of(panel, has_key) + '\n' + FigureFrame::end_panel();
    }
    return frame.draw(stem, commands, data_file(table_, data_), spec_.alt);
  }

 private:
  bool has_rows() const { return !spec_.rows.columns.empty(); }
  bool is_ordinal() const { return !has_rows() && spec_.x.scale == AxisScale::ordinal; }

  FacetShape shape() const {
    FacetShape shape;
    shape.panels = panels_.size();
    shape.measures = measures_.size();
    shape.series = series_.size();
    shape.rows = rows_.size();
    shape.has_titles = std::ranges::any_of(
        panels_, [&](std::size_t panel) { return !title_of(spec_.panels, panel).empty(); });
    shape.is_own_x = is_ordinal();
    shape.row_names = has_rows() ? widest(spec_.rows, rows_) + 26.0 : 0.0;
    shape.key = series_.size() > 1 ? widest(spec_.series, series_) + 66.0 : 24.0;
    return shape;
  }

  /// The functions by which the plots select their rows: the value, or NaN in other rows.
  std::string head() const {
    std::string text =
        "set datafile separator comma\nset datafile columnheaders\nset errorbars 0 lw 0.8 dt 1\n"
        "at_least(v, least) = v < least ? least : v\n";
    for (const std::size_t panel : panels_) {
      text += selection("panel", panel, condition_of(spec_.panels, panel));
    }
    for (const std::size_t series : series_) {
      text += selection("series", series, condition_of(spec_.series, series));
    }
    for (std::size_t mark = 0; mark < spec_.marks.size(); ++mark) {
      text += selection("mark", mark, condition_of(spec_.marks[mark].where));
    }
    if (has_rows()) {
      std::string places;
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        places +=
            fmt::format("{} ? {} : ", condition_of(spec_.rows, rows_[i]), rows_.size() - 1 - i);
      }
      text += fmt::format("place(v) = {}NaN\n", places);
      text += "set grid noytics\nset border 1\nset xtics nomirror\n";
    }
    return text;
  }

  /// The cells of an ordinal axis in one panel, by value.
  std::vector<std::string> steps_of(std::size_t panel) const {
    std::map<double, std::string> steps;
    for (const FacetRow& row : data_) {
      if (row.panel == panel) steps.emplace(row.x, row.cells.text(spec_.x.column));
    }
    std::vector<std::string> texts;
    for (const auto& [value, text] : steps) texts.push_back(text);
    return texts;
  }

  /// The range of an axis: over all panels, but with rows over the given one.
  Range range_of(const FigureAxis& axis, std::size_t panel) const {
    Range range;
    const auto include = [&](double value) {
      const bool is_drawable = axis.scale != AxisScale::log || value > 0.0;
      if (is_drawable) range.include(value);
    };
    for (const FacetRow& row : data_) {
      if (has_rows() && row.panel != panel) continue;
      include(experiments::drawn_value(axis, row.cells));
      if (axis.low.empty()) continue;
      for (const std::string& end : {axis.low, axis.high}) {
        include(experiments::drawn_value(axis, row.cells, end));
      }
    }
    return with_margin(range, axis);
  }

  /// Commands for one numeric axis, "x" or "y".
  static std::string numeric_axis(const char* name, const FigureAxis& axis, const Range& range,
                                  bool has_tics, double most_tics) {
    const bool is_log = axis.scale == AxisScale::log;
    return fmt::format(
        "{} logscale {}\nset {}range [{:.6g}:{:.6g}]\nset {}tics {}\n"
        "set format {} '{}'\n",
        is_log ? "set" : "unset", name, name, range.from, range.to, name,
        is_log ? "autofreq" : fmt::format("{:.6g}", tick_step(range.to - range.from, most_tics)),
        name, has_tics ? "%g" : "");
  }

  std::string axes_of(const FacetPanel& place, const FacetLayout& layout) const {
    const std::size_t panel = panels_[place.panel];
    const FigureAxis& measure = *measures_[place.measure];
    const Range range = range_of(measure, panel);
    std::string text =
        fmt::format("set title {} offset 0,-0.6\n",
                    gnuplot_text(place.has_title ? title_of(spec_.panels, panel) : std::string()));
    if (has_rows()) {
      std::vector<std::string> names;
      for (const std::size_t row : rows_) names.push_back(title_of(spec_.rows, row));
      text += numeric_axis("x", measure, range, true, layout.panel_width / 55.0);
      text += fmt::format(
          "set yrange [-0.6:{}]\nset xlabel {}\n{}\n", static_cast<double>(rows_.size()) - 0.4,
          gnuplot_text(place.has_x_title ? label(measure) : std::string()),
          place.is_leftmost
              ? fmt::format("set ytics scale 0 ({}) textcolor rgb '#22262b'", row_tics(names))
              : std::string("unset ytics"));
      return text;
    }
    if (is_ordinal()) {
      const std::vector<std::string> steps = steps_of(panel);
      std::string places, tics;
      for (std::size_t i = 0; i < steps.size(); ++i) {
        places += fmt::format("{} ? {} : ", condition_of({{spec_.x.column, steps[i]}}), i);
        tics += fmt::format("{}{} {}", i > 0 ? ", " : "", gnuplot_text(steps[i]), i);
      }
      text += fmt::format("place(v) = {}NaN\nset xrange [-0.5:{}]\nset xtics ({})\n", places,
                          static_cast<double>(steps.size()) - 0.5, tics);
    } else {
      text += numeric_axis("x", spec_.x, range_of(spec_.x, panel), place.has_x_tics,
                           layout.panel_width / 55.0);
    }
    text += numeric_axis("y", measure, range, place.is_leftmost, layout.panel_height / 40.0);
    return text + fmt::format("set xlabel {}\nset ylabel {}\n",
                              gnuplot_text(place.has_x_title ? label(spec_.x) : std::string()),
                              gnuplot_text(place.is_leftmost ? label(measure) : std::string()));
  }

  /// How far a series is shifted sideways so that intervals do not cover each other.
  double aside_of(std::size_t place, std::size_t panel, const FigureAxis& measure) const {
    const auto count = static_cast<double>(series_.size());
    const double middle = static_cast<double>(place) - 0.5 * (count - 1.0);
    if (has_rows()) return -0.6 / count * middle;
    if (is_ordinal()) return 0.5 / count * middle;
    if (measure.low.empty() || spec_.x.scale == AxisScale::log) return 0.0;
    const Range range = range_of(spec_.x, panel);
    return 0.01 * (range.to - range.from) * middle;
  }

  /// The functions that select the rows of a plot.
  std::vector<std::string> selections(std::size_t panel, std::size_t series,
                                      std::size_t mark) const {
    std::vector<std::string> names;
    if (!spec_.panels.columns.empty()) names.push_back(fmt::format("panel{}", panel + 1));
    if (!spec_.series.columns.empty()) names.push_back(fmt::format("series{}", series + 1));
    if (!spec_.marks[mark].where.empty()) names.push_back(fmt::format("mark{}", mark + 1));
    return names;
  }

  std::string plots_of(const FacetPanel& place, bool has_key) const {
    const std::size_t panel = panels_[place.panel];
    std::string text, separator;
    const auto add = [&](const std::string& plot) {
      text += separator + plot;
      separator = ", \\\n     ";
    };
    for (std::size_t i = 0; i < series_.size(); ++i) {
      const std::string style = series_style(spec_, series_[i]);
      for (std::size_t mark = 0; mark < spec_.marks.size(); ++mark) {
        const bool is_drawn = std::any_of(data_.begin(), data_.end(), [&](const FacetRow& row) {
          return row.panel == panel && row.series == series_[i] &&
                 experiments::passes(row.cells, spec_.marks[mark].where);
        });
        if (!is_drawn) continue;
        const FacetPlot plot{.selections = selections(panel, series_[i], mark),
                             .aside = aside_of(i, panel, *measures_[place.measure]),
                             .style = style};
        add(plot_command(spec_, *measures_[place.measure], spec_.marks[mark].shape, file_, plot));
      }
      if (has_key) {
        add(fmt::format("keyentry with {} {} title {}", key_shape(spec_), style,
                        gnuplot_text(title_of(spec_.series, series_[i]))));
      }
    }
    return text.empty() ? "NaN notitle" : text;
  }

  const FigureSpec& spec_;
  const Table& table_;
  std::vector<FacetRow> data_;
  std::string file_;
  std::vector<std::size_t> panels_, series_, rows_;
  std::vector<const FigureAxis*> measures_;
};

}  // namespace

std::optional<Figure> draw_facets(const experiments::FigureSpec& spec, const Table& table,
                                  const std::filesystem::path& stem) {
  const FacetFigure figure(spec, table, stem);
  if (figure.is_empty()) return {};
  return figure.draw(stem);
}

}  // namespace touchdown::render
