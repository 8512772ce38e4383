#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/interval.hpp"

namespace touchdown {

/// A table of texts: a header, then rows with as many cells. The functions below format it.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
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

/// Header and rows of a table for programs: texts, then numbers with intervals, then texts again.
/// Each number has the columns `name`, `name_low`, `name_high`. A unit (_ms, _nm) stays last, as in
/// `name_low_ms`. The number cells are formatted by `metric`.
std::vector<std::string> header_with_intervals(std::vector<std::string> first,
                                               const std::vector<std::string>& names,
                                               const std::vector<std::string>& last = {});
std::vector<std::string> row_with_intervals(std::vector<std::string> first,
                                            const std::vector<Interval>& intervals,
                                            const std::vector<std::string>& last = {});

/// For people: `0.987 [0.981, 0.992]`; a dash for an undefined value.
std::string with_interval(const Interval& interval, int decimals = 3);

}  // namespace touchdown
