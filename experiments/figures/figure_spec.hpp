#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace touchdown::experiments {

/// How figures are printed: the section `figures` of an experiment. It changes no result.
struct PrintConfig {
  std::optional<double> width_mm = {};  ///< in print, with text of at least 6 pt; empty: on screens
  bool caption = true;                  ///< whether the picture contains title and caption
  std::string heatmap = "success";      ///< metric of the maps over noise, a `PointMetric`
  std::string only = {};                ///< name of the figure to draw; empty: all. Not in the file
};

/// The widths that `PrintConfig` permits (mm).
inline constexpr double narrowest_print = 40.0, widest_print = 400.0;

/// A condition on a row of a table: the cell in this column has this text.
struct CellFilter {
  std::string column;
  std::string value;
};

/// The rows with these values in the columns of the `FigureGroups`, and their title.
struct FigureGroup {
  std::vector<std::string> values;
  std::string title;
};

/// A partition of a table's rows, in the order in which they are drawn. A row of no group is not
/// drawn. Without columns, all rows are one group without a title.
struct FigureGroups {
  std::vector<std::string> columns = {};
  std::vector<FigureGroup> groups = {};
};

/// `ordinal` gives every value of a panel the same distance from the next.
enum class AxisScale { linear, log, ordinal };

/// A column of numbers along an axis. A value v is drawn at `offset` + `factor` · v.
struct FigureAxis {
  std::string column;
  std::string title;
  std::string unit = {};            ///< of the drawn values; empty: none
  std::string low = {}, high = {};  ///< columns of the interval's ends; empty: no interval
  AxisScale scale = AxisScale::linear;
  double factor = 1.0, offset = 0.0;
  std::optional<double> floor = {};          ///< smaller values are drawn at this one
  std::optional<double> from = {}, to = {};  ///< ends of the axis; empty: by the values
  bool has_diagonal = false;                 ///< of a measure: a line where it equals x
};

/// A `line` is a curve without points; a figure of lines alone has wide panels, as over time. A
/// `step` holds its value until the next one. An `image` is a cell at x and `FigureSpec::y` with
/// the first measure as its colour: a share in percent, the colours logarithmic in its distance
/// from 100. A `number` writes the share, and its interval, where up to 64 cells have room for it.
enum class MarkShape { curve, line, step, points, ring, cross, image, number };

/// The look of the rows that pass all of `where`. Marks may overlap: a row has each
/// mark with conditions that it passes.
struct FigureMark {
  MarkShape shape = MarkShape::curve;
  std::vector<CellFilter> where = {};
  std::string measure = {};  ///< the column of the only measure that has it; empty: all
};

/// A figure of a CSV table: a panel per group of `panels` and measure, a curve per group of
/// `series`. The measures are drawn over `x`. With `rows` they are drawn along the horizontal axis
/// instead, beside a list of these groups, and `x` has no meaning.
struct FigureSpec {
  std::string name;   ///< of the files, without extension
  std::string table;  ///< file name
  std::vector<CellFilter> where = {};
  FigureGroups panels = {};
  FigureGroups series = {};
  FigureGroups rows = {};
  FigureAxis x = {};
  FigureAxis y = {};  ///< of images, whose axes are both ordinal
  std::vector<FigureAxis> measures = {};
  std::vector<FigureMark> marks = {{}};
  /// The experiment's estimators: a series gets its colour by the place of its first value among
  /// these names. Empty: by its place among the series.
  std::vector<std::string> colour_order = {};
  std::string title = {};
  std::string caption = {};
  std::string alt = {};  ///< a description for readers who cannot see the figure
};

/// Whether a row of the table passes all conditions.
bool passes(const TableRow& row, const std::vector<CellFilter>& where);

/// The first group with the row's values: its place; 0 without columns, empty for a row of no
/// group.
std::optional<std::size_t> group_of(const FigureGroups& groups, const TableRow& row);

/// The distinct values of a column among the rows that pass `where`, in the order of the rows, each
/// with its title.
FigureGroups groups_in(const Table& table, const std::string& column,
                       const std::function<std::string(const std::string& value)>& title,
                       const std::vector<CellFilter>& where = {});

/// The same for the combinations of values of several columns.
FigureGroups combinations_in(
    const Table& table, const std::vector<std::string>& columns,
    const std::function<std::string(const std::vector<std::string>& values)>& title,
    const std::vector<CellFilter>& where = {});

/// A panel per noise setting, for a table with the columns of `noise_columns`.
FigureGroups noise_panels(const Table& table);

/// The axis of a measured column, with the columns of its interval beside it.
FigureAxis axis_with_interval(const std::string& column, const std::string& title);

/// A row's value in a column as an axis draws it; NaN without a number. The column is the axis's
/// own, or that of an end of its interval.
double drawn_value(const FigureAxis& axis, const TableRow& row, const std::string& column);
inline double drawn_value(const FigureAxis& axis, const TableRow& row) {
  return drawn_value(axis, row, axis.column);
}

/// The drawn values of the first measure as a text, panel by panel and series by series, for a
/// figure's alternative text. It begins with a space.
std::string values_text(const FigureSpec& spec, const Table& table);

/// What a study found, besides its files.
struct StudyResult {
  std::vector<std::string> texts = {};           ///< for the terminal
  std::vector<std::string> failed_demands = {};  ///< estimators that fail a demanded verdict
  std::vector<FigureSpec> figures = {};          ///< of its tables
};

}  // namespace touchdown::experiments
