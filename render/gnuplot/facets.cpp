#include "render/gnuplot/facets.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "render/gnuplot/facet_script.hpp"
#include "render/gnuplot/frame.hpp"

namespace touchdown::render {

namespace {

using experiments::AxisScale;
using experiments::FigureAxis;
using experiments::FigureGroups;
using experiments::FigureSpec;

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
  std::vector<std::string> titles;
  for (const std::size_t place : places) titles.push_back(title_of(groups, place));
  return text_width(titles);
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

/// The tics of a logarithmic axis: decades, with numbers between them on an axis of less than two.
std::string log_tics(const Range& range) {
  if (!(range.from > 0.0) || range.to > 100.0 * range.from) return "autofreq";
  const bool is_narrow = range.to < 4.0 * range.from;
  const std::vector<double> digits =
      is_narrow ? std::vector{1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0} : std::vector{1.0, 2.0, 5.0};
  std::vector<std::string> tics;
  for (int power = static_cast<int>(std::floor(std::log10(range.from)));
       std::pow(10.0, power) <= range.to; ++power) {
    for (const double digit : digits) tics.push_back(fmt::format("{}e{}", digit, power));
  }
  return fmt::format("({})", fmt::join(tics, ", "));
}

/// One figure: the drawn groups, and the commands of its panels.
class FacetFigure {
 public:
  FacetFigure(const FigureSpec& spec, const Table& table, const FigureFile& file)
      : spec_(spec),
        table_(table),
        data_(facet_rows(spec, table)),
        place_(file),
        file_(gnuplot_file(file.name() + ".dat")),
        panels_(used(data_, &FacetRow::panel)),
        series_(used(data_, &FacetRow::series)),
        rows_(has_rows() ? used(data_, &FacetRow::row) : std::vector<std::size_t>()) {
    for (const FigureAxis& measure : spec.measures) {
      const bool has_values = std::any_of(data_.begin(), data_.end(), [&](const FacetRow& row) {
        return !std::isnan(experiments::drawn_value(measure, row.cells));
      });
      if (has_values) measures_.push_back(&measure);
    }
    const bool has_image = std::ranges::any_of(spec.marks, [](const experiments::FigureMark& mark) {
      return mark.shape == experiments::MarkShape::image;
    });
    if (has_image && !is_empty()) {
      cells_ = image_cells(steps_of(spec.x, {}).size(), steps_of(spec.y, {}).size(),
                           !measures_.front()->low.empty(), file.room());
    }
  }

  bool is_empty() const { return measures_.empty(); }

  Figure draw() const {
    const FacetLayout layout = facet_layout(shape());
    const FigureFrame frame(place_, {spec_.title, spec_.caption, spec_.alt}, layout.width,
                            layout.height);
    std::string commands = head();
    for (const FacetPanel& panel : layout.panels) {
      commands += frame.panel(panel.left, panel.top, layout.panel_width, layout.panel_height);
      commands += axes_of(panel, layout);
      const bool is_first = &panel == &layout.panels.front();
      const bool has_key = is_first && series_.size() > 1;
      commands += has_key ? frame.key(layout.key_left, layout.key_top - 6.0) : "unset key\n";
      if (is_image()) {
        commands += !is_first ? "unset colorbox\n"
                              : frame.colour_bar(layout.key_left, layout.key_top, 14.0,
                                                 layout.panel_height) +
                                    fmt::format("set cblabel {} offset 0.4,0\n",
                                                gnuplot_text(label(*measures_.front())));
      }
      commands += "plot " + plots_of(panel, has_key) + '\n' + FigureFrame::end_panel();
    }
    return frame.draw(commands, data_file(table_, data_));
  }

 private:
  bool has_rows() const { return !spec_.rows.columns.empty(); }
  bool is_image() const { return cells_.columns > 0; }
  bool is_ordinal() const { return !has_rows() && spec_.x.scale == AxisScale::ordinal; }

  FacetShape shape() const {
    FacetShape shape;
    shape.room = place_.room();
    shape.panels = panels_.size();
    shape.measures = measures_.size();
    shape.series = series_.size();
    shape.rows = is_image() ? cells_.rows : rows_.size();
    shape.has_titles = std::ranges::any_of(
        panels_, [&](std::size_t panel) { return !title_of(spec_.panels, panel).empty(); });
    shape.is_own_x = is_ordinal();
    shape.is_wide = std::ranges::all_of(spec_.marks, [](const experiments::FigureMark& mark) {
      return mark.shape == experiments::MarkShape::line;
    });
    constexpr double axis_title = 42.0;  // px, with the tics' distance
    shape.row_names = has_rows()   ? widest(spec_.rows, rows_) + 26.0
                      : is_image() ? std::max(text_width(steps_of(spec_.y, {})) + axis_title, 68.0)
                                   : 0.0;
    shape.key = is_image()           ? scale_width
                : series_.size() > 1 ? widest(spec_.series, series_) + 66.0
                                     : 24.0;
    shape.cells = cells_;
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
    if (is_image()) text += image_style();
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

  /// The texts on an ordinal axis in one panel, or in all of them, by value.
  std::vector<std::string> steps_of(const FigureAxis& axis,
                                    std::optional<std::size_t> panel) const {
    std::map<double, std::string> steps;
    for (const FacetRow& row : data_) {
      if (panel && row.panel != *panel) continue;
      steps.emplace(experiments::drawn_value(axis, row.cells), row.cells.text(axis.column));
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
        is_log ? log_tics(range)
               : fmt::format("{:.6g}", tick_step(range.to - range.from, most_tics)),
        name,
        // "100k": wide numbers would push the title out.
        !has_tics                   ? ""
        : is_log && range.to >= 1e4 ? "%.0s%c"
                                    : "%g");
  }

  /// Commands for an axis of equally spaced values in `length` px, with as many of their texts as
  /// fit: every one, every second, ... Their places are the function `<name>place`.
  std::string ordinal_axis(const char* name, const FigureAxis& axis, std::size_t panel,
                           bool has_tics, double length) const {
    const std::vector<std::string> steps =
        steps_of(axis, is_image() ? std::nullopt : std::optional(panel));
    const auto count = static_cast<double>(steps.size());
    const double needed = *name == 'x' ? text_width(steps) + 5.0 : 20.0;  // px
    const auto every = static_cast<std::size_t>(std::ceil(needed * count / length));
    std::string places, tics;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      places += fmt::format("{} ? {} : ", condition_of({{axis.column, steps[i]}}), i);
      if (i % every != 0) continue;
      tics +=
          fmt::format("{}{} {}", i > 0 ? ", " : "", has_tics ? gnuplot_text(steps[i]) : "''", i);
    }
    return fmt::format("{0}place(v) = {1}NaN\nset {0}range [-0.5:{2}]\nset {0}tics ({3})\n", name,
                       places, count - 0.5, tics);
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
    text += is_ordinal() ? ordinal_axis("x", spec_.x, panel, place.has_x_tics, layout.panel_width)
                         : numeric_axis("x", spec_.x, range_of(spec_.x, panel), place.has_x_tics,
                                        layout.panel_width / 55.0);
    text += is_image()
                ? ordinal_axis("y", spec_.y, panel, place.is_leftmost, layout.panel_height)
                : numeric_axis("y", measure, range, place.is_leftmost, layout.panel_height / 40.0);
    return text + fmt::format(
                      "set xlabel {}\nset ylabel {}\n",
                      gnuplot_text(place.has_x_title ? label(spec_.x) : std::string()),
                      gnuplot_text(place.is_leftmost ? label(is_image() ? spec_.y : measure) : ""));
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
      if (plot.empty()) return;
      text += separator + plot;
      separator = ", \\\n     ";
    };
    if (measures_[place.measure]->has_diagonal) add("x with lines lc rgb '#9aa1a8' dt 1 notitle");
    for (std::size_t i = 0; i < series_.size(); ++i) {
      const std::string style = series_style(spec_, series_[i]);
      const bool is_curve = key_shape(spec_) != std::string_view("points");
      const std::string curve_style = is_curve && style.starts_with("lt ")
                                          ? style + ' ' + curve_width(i, series_.size())
                                          : style;
      for (std::size_t mark = 0; mark < spec_.marks.size(); ++mark) {
        const std::string& only = spec_.marks[mark].measure;
        if (!only.empty() && only != measures_[place.measure]->column) continue;
        const bool is_drawn = std::any_of(data_.begin(), data_.end(), [&](const FacetRow& row) {
          return row.panel == panel && row.series == series_[i] &&
                 experiments::passes(row.cells, spec_.marks[mark].where);
        });
        if (!is_drawn) continue;
        const auto shape = spec_.marks[mark].shape;
        if (is_image()) {
          add(image_plot(shape, cells_.content, file_, selections(panel, series_[i], mark),
                         *measures_[place.measure]));
          continue;
        }
        const FacetPlot plot{.selections = selections(panel, series_[i], mark),
                             .aside = aside_of(i, panel, *measures_[place.measure]),
                             .style = is_highlight(shape) ? style : curve_style};
        add(plot_command(spec_, *measures_[place.measure], shape, file_, plot));
      }
      if (has_key) {
        add(fmt::format("keyentry with {} {} title {}", key_shape(spec_), curve_style,
                        gnuplot_text(title_of(spec_.series, series_[i]))));
      }
    }
    return text.empty() ? "NaN notitle" : text;
  }

  const FigureSpec& spec_;
  const Table& table_;
  std::vector<FacetRow> data_;
  const FigureFile& place_;
  std::string file_;
  std::vector<std::size_t> panels_, series_, rows_;
  std::vector<const FigureAxis*> measures_;
  ImageCells cells_;  ///< none: no image
};

}  // namespace

std::optional<Figure> draw_facets(const experiments::FigureSpec& spec, const Table& table,
                                  const FigureFile& file) {
  const FacetFigure figure(spec, table, file);
  if (figure.is_empty()) return {};
  return figure.draw();
}

}  // namespace touchdown::render
