#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/table.hpp"

namespace touchdown {

/// A table as `to_csv` wrote it: quoted cells may hold commas, quotes and line ends. Short rows are
/// filled up with empty cells. Nothing when there is no such file or it is empty.
std::optional<Table> read_csv(const std::filesystem::path& path);

/// A row of a table, by the names of its columns.
class TableRow {
 public:
  TableRow(const Table& table, std::size_t row) : table_(table), row_(row) {}

  bool has(std::string_view column) const;
  /// Empty for a column that is not there.
  const std::string& text(std::string_view column) const;
  /// NaN for what is not there or no number.
  double number(std::string_view column) const;
  /// Columns `name`, `name_low`, `name_high`; the unit, if any, stays last: `latency_low_ms`.
  Interval interval(const std::string& name) const;

 private:
  const Table& table_;
  std::size_t row_;
};

std::vector<TableRow> rows_of(const Table& table);

/// Where the end of an interval is found: "latency_ms", "_low" → "latency_low_ms".
std::string interval_column(const std::string& name, const std::string& end);

}  // namespace touchdown
