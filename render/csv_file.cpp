#include "render/csv_file.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

#include "core/files.hpp"

namespace touchdown {
namespace {

/// All cells of the text, row by row.
std::vector<std::vector<std::string>> cells_of(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, std::vector<std::string>(1));
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string& cell = rows.back().back();
    const char c = text[i];
    if (quoted) {
      if (c != '"') {
        cell += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        cell += text[++i];
      } else {
        quoted = false;
      }
    } else if (c == '"' && cell.empty()) {
      quoted = true;
    } else if (c == ',') {
      rows.back().emplace_back();
    } else if (c == '\n') {
      rows.emplace_back(1);
    } else if (c != '\r') {
      cell += c;
    }
  }
  std::erase_if(rows, [](const auto& row) { return row.size() == 1 && row[0].empty(); });
  return rows;
}

std::optional<std::size_t> column_of(const Table& table, std::string_view name) {
  const auto found = std::find(table.header.begin(), table.header.end(), name);
  if (found == table.header.end()) return std::nullopt;
  return static_cast<std::size_t>(found - table.header.begin());
}

}  // namespace

std::optional<Table> read_csv(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  std::vector<std::vector<std::string>> rows = cells_of(read_file(path));
  if (rows.empty()) return std::nullopt;
  Table table{std::move(rows.front()), {}};
  for (std::size_t i = 1; i < rows.size(); ++i) {
    rows[i].resize(table.header.size());
    table.rows.push_back(std::move(rows[i]));
  }
  return table;
}

bool TableRow::has(std::string_view column) const { return column_of(table_, column).has_value(); }

const std::string& TableRow::text(std::string_view column) const {
  static const std::string nothing;
  const auto index = column_of(table_, column);
  return index ? table_.rows[row_][*index] : nothing;
}

double TableRow::number(std::string_view column) const {
  const std::string& cell = text(column);
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

Interval TableRow::interval(const std::string& name) const {
  return {number(name), number(interval_column(name, "_low")),
          number(interval_column(name, "_high"))};
}

std::vector<TableRow> rows_of(const Table& table) {
  std::vector<TableRow> rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i) rows.emplace_back(table, i);
  return rows;
}

std::string interval_column(const std::string& name, const std::string& end) {
  if (name.ends_with("_ms")) return name.substr(0, name.size() - 3) + end + "_ms";
  return name + end;
}

}  // namespace touchdown
