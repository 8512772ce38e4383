#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/interval.hpp"

namespace touchdown {

/// A table of texts: one header row, then rows of as many cells. What is written is decided by who
/// fills it; how, by the writers below.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// Comma-separated values (RFC 4180: cells with commas or quotes are quoted), one line per row.
std::string to_csv(const Table& table);

/// The inverse: quoted cells may hold commas, quotes and line ends; short rows are filled up with
/// empty cells.
Table from_csv(std::string_view text);

/// A row's cell under the column of that name; "nan" where the table has none.
std::string cell(const Table& table, const std::vector<std::string>& row, std::string_view column);

/// Aligned for a terminal, without a header if it is empty: the first `text_columns` columns to the
/// left, the others to the right.
std::string to_text(const Table& table, std::size_t text_columns = 1);

/// Number of characters as a terminal counts them, for UTF-8 text.
std::size_t width(const std::string& text);

/// Plain numbers for CSV files: the shortest text that reads back to the same number, and a metric
/// with six decimals. `nan` for what is not defined.
std::string exact(double value);
std::string metric(double value);

/// A table for programs whose rows are texts, then numbers with their intervals, then texts again.
/// A number has the columns `name`, `name_low`, `name_high`; a unit (_ms, _nm) stays last:
/// `name_low_ms`. Its cells are metrics.
std::vector<std::string> header_with_intervals(std::vector<std::string> first,
                                               const std::vector<std::string>& names,
                                               const std::vector<std::string>& last = {});
std::vector<std::string> row_with_intervals(std::vector<std::string> first,
                                            const std::vector<Interval>& intervals,
                                            const std::vector<std::string>& last = {});

/// For people: `0.987 [0.981, 0.992]`; a dash for what is not defined.
std::string with_interval(const Interval& interval, int decimals = 3);

}  // namespace touchdown
