#include "core/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "core/terminal_text.hpp"

namespace touchdown {

namespace {

bool is_number(std::string_view text) {
  double number = 0.0;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

/// Whether spreadsheets compute this cell: names come from files and command lines. Cells with an
/// apostrophe in front count, too, so that it can be removed again.
bool is_formula(std::string_view cell) {
  cell.remove_prefix(std::min(cell.find_first_not_of('\''), cell.size()));
  return cell.size() > 1 && std::string_view("=+-@\t\r").find(cell.front()) != std::string::npos &&
         !is_number(cell);
}

std::string csv_cell(std::string cell) {
  if (is_formula(cell)) cell.insert(0, 1, '\'');
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string quoted(1, '"');
  for (const char c : cell) quoted.append(c == '"' ? 2 : 1, c);
  quoted.push_back('"');
  return quoted;
}

std::string padded(const std::string& cell, std::size_t to, bool left) {
  const std::string space(to - width(cell), ' ');
  return left ? cell + space : space + cell;
}

/// Cells come from files, too: a line end or an escape sequence would break the table.
Table shown(Table table) {
  const auto show = [](std::vector<std::string>& cells) {
    for (std::string& cell : cells) cell = terminal_text(cell);
  };
  show(table.header);
  for (std::vector<std::string>& row : table.rows) show(row);
  return table;
}

}  // namespace

std::vector<std::string> ColumnInfo::cell_names() const {
  if (!has_bounds) return {name};
  const bool has_unit = name.ends_with("_ms") || name.ends_with("_nm");
  const std::size_t stem = name.size() - (has_unit ? 3 : 0);
  std::vector<std::string> names;
  for (const char* end : {"", "_low", "_high"})
    names.push_back(std::string(name).insert(stem, end));
  return names;
}

std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
  }));
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::vector<std::string> quoted;
  std::transform(cells.begin(), cells.end(), std::back_inserter(quoted), csv_cell);
  return fmt::format("{}\n", fmt::join(quoted, ","));
}

std::string to_csv(const Table& table) {
  std::string text = csv_line(table.header);
  for (const auto& row : table.rows) text += csv_line(row);
  return text;
}

std::string cell(const Table& table, const std::vector<std::string>& row, std::string_view column) {
  const auto found = std::find(table.header.begin(), table.header.end(), column);
  const auto index = static_cast<std::size_t>(found - table.header.begin());
  return index < row.size() ? row[index] : "nan";
}

Table from_csv(std::string_view text) {
  std::istringstream lines{std::string(text)};
  CsvRows rows(lines);
  Table table;
  while (rows.next()) {
    while (rows.is_open() && rows.append_line()) continue;
    std::vector<std::string> row;
    for (const CsvCell& cell : rows.cells()) row.push_back(content_of(cell));
    if (row.back().ends_with('\r')) row.back().pop_back();
    for (std::string& one : row) {
      if (one.starts_with('\'') && is_formula(std::string_view(one).substr(1))) one.erase(0, 1);
    }
    if (row.size() == 1 && row.front().empty()) continue;
    if (table.header.empty()) {
      table.header = std::move(row);
    } else {
      row.resize(table.header.size());
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

std::string to_text(const Table& raw, std::size_t text_columns) {
  const Table table = shown(raw);
  std::vector<std::size_t> widths(table.header.size(), 0);
  const auto measure = [&](const std::vector<std::string>& cells) {
    widths.resize(std::max(widths.size(), cells.size()), 0);
    for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], width(cells[i]));
  };
  measure(table.header);
  for (const auto& row : table.rows) measure(row);

  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      text.append(i == 0 ? 2 : 3, ' ');
      text += padded(cells[i], widths[i], i < text_columns);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text + "\n";
  };
  std::string text;
  if (!table.header.empty()) {
    text = line(table.header);
    std::vector<std::string> rule;
    for (const std::size_t columns : widths) rule.push_back(fmt::format("{:─<{}}", "", columns));
    text += line(rule);
  }
  for (const auto& row : table.rows) text += line(row);
  return text;
}

std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string exact(double value) { return std::isnan(value) ? "nan" : fmt::format("{}", value); }

std::string metric(double value) { return std::isnan(value) ? "nan" : fixed(value, 6); }

std::string with_interval(const Interval& interval, int decimals) {
  if (std::isnan(interval.estimate)) return "–";
  if (std::isnan(interval.low)) return fixed(interval.estimate, decimals);
  return fmt::format("{} [{}, {}]", fixed(interval.estimate, decimals),
                     fixed(interval.low, decimals), fixed(interval.high, decimals));
}

}  // namespace touchdown
