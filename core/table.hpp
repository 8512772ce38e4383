#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "core/interval.hpp"

namespace touchdown {

/// What a column contributes to a long table, which has one row per number.
enum class ColumnRole : int {
  key,     ///< identifies the row: a name, a level, a threshold
  metric,  ///< a measured number or count
  low,     ///< the lower end of the interval of the metric before it
  high,    ///< the upper one
  runs,    ///< the number of runs behind the metrics of its row
  note     ///< a remark; long tables omit it
};

/// The type of a column's cells, and how they are printed.
enum class ColumnType : int {
  text,
  count,    ///< a whole number
  exact,    ///< a number that was set, not measured, with all of its digits
  measured  ///< a number with six decimals
};

/// A column without its cells.
struct Column {
  std::string name;  ///< a metric's name ends with its unit (`_ms`, `_nm`)
  ColumnRole role = ColumnRole::key;
  ColumnType type = ColumnType::text;
  std::string as = name;  ///< its name in long tables

  static auto members(auto& column) {
    return std::tie(column.name, column.role, column.type, column.as);
  }
  bool operator==(const Column&) const = default;
};

/// A value of a table. A missing number is NaN, a missing text is empty.
using Cell = std::variant<std::string, std::int64_t, double>;

class TableRow;

/// A table: typed columns, and rows with a cell for each. CSV, JSON, `results.csv` and figures are
/// prints of it. Measured numbers are rounded as they are printed, so that a table which is read
/// from its file equals the written one.
struct Table {
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;

  /// The rows with access to their cells by name. They refer to the table.
  std::vector<TableRow> all() const;
};

/// A row of a table, with access to its cells by the names of their columns.
class TableRow {
 public:
  TableRow(const Table& table, std::size_t row) : table_(&table), cells_(&table.rows[row]) {}

  /// The cell as it is printed; "nan" without such a column.
  std::string text(std::string_view column) const;
  /// The number of the cell, or the one with which its text begins; NaN without one.
  double number(std::string_view column) const;
  /// A number, and those of `bound_name`.
  Interval interval(const std::string& column) const;
  /// All cells as they are printed.
  std::vector<std::string> texts() const;

 private:
  std::size_t index_of(std::string_view column) const;

  const Table* table_;
  const std::vector<Cell>* cells_;
};

/// The column of an interval's end, "_low" or "_high": a unit (_ms, _nm) stays last, as in
/// `name_low_ms`.
std::string bound_name(const std::string& name, const char* end);

/// Appends the three columns, or the three cells, of a measured number with its interval.
void add_interval(const std::string& name, std::vector<Column>& columns);
void add_interval(const Interval& interval, std::vector<Cell>& cells);

/// These columns of a table, in this order. A metric brings the ends of its interval along. Errors:
/// `Error` for a column that it lacks.
Table select(const Table& table, const std::vector<std::string>& columns);

/// Adds the columns that a table lacks from one with as many rows. A table without columns takes
/// all.
void add_columns(Table& table, const Table& more);

/// A table for readers: a header, then rows with as many formatted cells.
struct TextTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// A table as it is printed, and a table of such texts. Columns that `columns` does not name are
/// texts.
TextTable texts_of(const Table& table);
Table table_of(const TextTable& texts, const std::vector<Column>& columns = {});

/// Comma-separated values (RFC 4180: cells with commas or quotes are quoted), one line per row. A
/// text that spreadsheets would compute, as it begins with = + - or @, is preceded by an
/// apostrophe.
std::string to_csv(const TextTable& table);
std::string to_csv(const Table& table);

/// One line of it.
std::string csv_line(const std::vector<std::string>& cells);

/// Parses CSV, the inverse of `to_csv`. Quoted cells may contain commas, quotes and line ends.
/// Short rows are padded with empty cells.
TextTable from_csv(std::string_view text);

/// The cell of a row in the named column; "nan" if the table has no such column.
std::string cell(const TextTable& table, const std::vector<std::string>& row,
                 std::string_view column);

/// Formats a table for a terminal. The first `text_columns` columns are aligned left, the others
/// right. An empty header is left out.
std::string to_text(const TextTable& table, std::size_t text_columns = 1);
std::string to_text(const Table& table, std::size_t text_columns = 1);

/// Number of characters of a UTF-8 text, as a terminal counts them.
std::size_t width(const std::string& text);

/// `text` broken into lines of at most `columns` characters; a longer word has a line of its own.
std::string wrapped(std::string_view text, std::size_t columns);

/// A number with so many decimals, or like 1e+18 if it is beyond any quantity; never a negative
/// zero.
std::string fixed(double value, int decimals);
/// A number with so many digits, also more before its point: 1234, 0.0123, 1e+18.
std::string readable(double value, int digits);

/// Numbers for CSV files: `exact` is the shortest text that reads back to the same number, `metric`
/// has six decimals. Undefined values are `nan`.
std::string exact(double value);
std::string metric(double value);

/// The number that `metric` prints.
double rounded(double value);

/// For people: `0.987 [0.981, 0.992]`; a dash for an undefined value.
std::string with_interval(const Interval& interval, int decimals = 3);

}  // namespace touchdown
