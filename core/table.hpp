#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/interval.hpp"

namespace touchdown {

/// What a column contributes to a long table, which has one row per number.
enum class ColumnRole : int {
  key,     ///< identifies the row: a name, a level, a threshold
  metric,  ///< a measured number or count
  runs,    ///< the number of runs behind the metrics of its row
  note     ///< a remark; long tables omit it
};

/// A column without its cells.
struct ColumnInfo {
  std::string name;  ///< a metric's name ends with its unit (`_ms`, `_nm`)
  ColumnRole role = ColumnRole::key;
  std::string as = name;    ///< its name in long tables
  bool has_bounds = false;  ///< three cells: estimate, low, high

  static auto members(auto& column) {
    return std::tie(column.name, column.role, column.as, column.has_bounds);
  }

  std::size_t cells() const { return has_bounds ? 3 : 1; }
  /// The names of its cells: `name`, `name_low`, `name_high`. A unit (_ms, _nm) stays last, as in
  /// `name_low_ms`.
  std::vector<std::string> cell_names() const;
};

/// A table: a header, then rows with as many cells. A cell is the text of its value as every file
/// has it, so that figures, the report and `results.csv` agree to the digit. CSV, JSON, Markdown,
/// LaTeX, text and figures are prints of a table.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  /// The meanings of the columns of measured rows (core/columns.hpp); otherwise empty.
  std::vector<ColumnInfo> columns = {};
};

/// Comma-separated values (RFC 4180: cells with commas or quotes are quoted), one line per row. A
/// text that spreadsheets would compute, as it begins with = + - or @, is preceded by an
/// apostrophe.
std::string to_csv(const Table& table);

/// One line of it.
std::string csv_line(const std::vector<std::string>& cells);

/// Parses CSV, the inverse of `to_csv`. Quoted cells may contain commas, quotes and line ends.
/// Short rows are padded with empty cells.
Table from_csv(std::string_view text);

/// The cell of a row in the named column; "nan" if the table has no such column.
std::string cell(const Table& table, const std::vector<std::string>& row, std::string_view column);

/// Formats a table for a terminal. The first `text_columns` columns are aligned left, the others
/// right. An empty header is left out.
std::string to_text(const Table& table, std::size_t text_columns = 1);

/// Number of characters of a UTF-8 text, as a terminal counts them.
std::size_t width(const std::string& text);

/// A number with so many decimals; never a negative zero.
std::string fixed(double value, int decimals);

/// Numbers for CSV files: `exact` is the shortest text that reads back to the same number, `metric`
/// has six decimals. Undefined values are `nan`.
std::string exact(double value);
std::string metric(double value);

/// For people: `0.987 [0.981, 0.992]`; a dash for an undefined value.
std::string with_interval(const Interval& interval, int decimals = 3);

}  // namespace touchdown
