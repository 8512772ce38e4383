#include "core/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/terminal_text.hpp"

namespace touchdown {

namespace {

/// The number with which a text begins; NaN without one.
double number_in(std::string_view text) {
  double number = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

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

std::string text_of(const Cell& cell, const Column& column) {
  if (const auto* const text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* const count = std::get_if<std::int64_t>(&cell)) return std::to_string(*count);
  const double number = std::get<double>(cell);
  return column.type == ColumnType::measured ? metric(number) : exact(number);
}

Cell cell_of(const std::string& text, ColumnType type) {
  if (type == ColumnType::text) return text;
  if (type == ColumnType::count) return static_cast<std::int64_t>(number_in(text));
  return number_in(text);
}

std::string padded(const std::string& cell, std::size_t to, bool left) {
  const std::string space(to - width(cell), ' ');
  return left ? cell + space : space + cell;
}

/// Cells come from files, too: a line end or an escape sequence would break the table.
TextTable shown(TextTable table) {
  const auto show = [](std::vector<std::string>& cells) {
    for (std::string& cell : cells) cell = terminal_text(cell);
  };
  show(table.header);
  for (std::vector<std::string>& row : table.rows) show(row);
  return table;
}

}  // namespace

std::vector<TableRow> Table::all() const {
  std::vector<TableRow> all;
  for (std::size_t row = 0; row < rows.size(); ++row) all.emplace_back(*this, row);
  return all;
}

std::size_t TableRow::index_of(std::string_view column) const {
  const auto found = std::ranges::find(table_->columns, column, &Column::name);
  return static_cast<std::size_t>(found - table_->columns.begin());
}

std::string TableRow::text(std::string_view column) const {
  const std::size_t index = index_of(column);
  return index < cells_->size() ? text_of((*cells_)[index], table_->columns[index]) : "nan";
}

double TableRow::number(std::string_view column) const {
  const std::size_t index = index_of(column);
  if (index >= cells_->size()) return std::numeric_limits<double>::quiet_NaN();
  const Cell& cell = (*cells_)[index];
  if (const auto* const number = std::get_if<double>(&cell)) return *number;
  if (const auto* const count = std::get_if<std::int64_t>(&cell)) {
    return static_cast<double>(*count);
  }
  return number_in(std::get<std::string>(cell));
}

Interval TableRow::interval(const std::string& column) const {
  return {number(column), number(bound_name(column, "_low")), number(bound_name(column, "_high"))};
}

std::vector<std::string> TableRow::texts() const {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < cells_->size(); ++i) {
    texts.push_back(text_of((*cells_)[i], table_->columns[i]));
  }
  return texts;
}

std::string bound_name(const std::string& name, const char* end) {
  const bool has_unit = name.ends_with("_ms") || name.ends_with("_nm");
  return std::string(name).insert(name.size() - (has_unit ? 3 : 0), end);
}

void add_interval(const std::string& name, std::vector<Column>& columns) {
  columns.push_back({name, ColumnRole::metric, ColumnType::measured});
  columns.push_back({bound_name(name, "_low"), ColumnRole::low, ColumnType::measured});
  columns.push_back({bound_name(name, "_high"), ColumnRole::high, ColumnType::measured});
}

void add_interval(const Interval& interval, std::vector<Cell>& cells) {
  for (const double value : {interval.estimate, interval.low, interval.high}) {
    cells.emplace_back(rounded(value));
  }
}

Table select(const Table& table, const std::vector<std::string>& columns) {
  std::vector<std::size_t> places;
  for (const std::string& name : columns) {
    const auto found = std::ranges::find(table.columns, name, &Column::name);
    if (found == table.columns.end()) throw Error("a table lacks the column " + name);
    auto place = static_cast<std::size_t>(found - table.columns.begin());
    do {
      places.push_back(place++);
    } while (place < table.columns.size() && (table.columns[place].role == ColumnRole::low ||
                                              table.columns[place].role == ColumnRole::high));
  }
  Table part;
  for (const std::size_t place : places) part.columns.push_back(table.columns[place]);
  for (const std::vector<Cell>& row : table.rows) {
    std::vector<Cell>& cells = part.rows.emplace_back();
    for (const std::size_t place : places) cells.push_back(row[place]);
  }
  return part;
}

void add_columns(Table& table, const Table& more) {
  if (table.columns.empty()) table.rows.resize(more.rows.size());
  for (std::size_t c = 0; c < more.columns.size(); ++c) {
    const auto same = std::ranges::find(table.columns, more.columns[c].name, &Column::name);
    if (same != table.columns.end()) continue;
    table.columns.push_back(more.columns[c]);
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      table.rows[row].push_back(more.rows[row][c]);
    }
  }
}

TextTable texts_of(const Table& table) {
  TextTable texts;
  for (const Column& column : table.columns) texts.header.push_back(column.name);
  for (const TableRow& row : table.all()) texts.rows.push_back(row.texts());
  return texts;
}

Table table_of(const TextTable& texts, const std::vector<Column>& columns) {
  Table table;
  for (const std::string& name : texts.header) {
    const auto known = std::ranges::find(columns, name, &Column::name);
    table.columns.push_back(known == columns.end() ? Column{name} : *known);
  }
  for (const std::vector<std::string>& row : texts.rows) {
    std::vector<Cell>& cells = table.rows.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i) {
      cells.push_back(cell_of(row[i], table.columns[i].type));
    }
  }
  return table;
}

std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }));
}

std::string wrapped(std::string_view text, std::size_t columns) {
  std::string result;
  std::size_t used = 0;
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    const std::size_t letters = width(word);
    const bool goes_on = used > 0 && used + 1 + letters <= columns;
    if (used > 0) result += goes_on ? ' ' : '\n';
    result += word;
    used = goes_on ? used + 1 + letters : letters;
  }
  return result;
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::vector<std::string> quoted;
  std::transform(cells.begin(), cells.end(), std::back_inserter(quoted), csv_cell);
  return fmt::format("{}\n", fmt::join(quoted, ","));
}

std::string to_csv(const TextTable& table) {
  std::string text = csv_line(table.header);
  for (const auto& row : table.rows) text += csv_line(row);
  return text;
}

std::string to_csv(const Table& table) { return to_csv(texts_of(table)); }

std::string cell(const TextTable& table, const std::vector<std::string>& row,
                 std::string_view column) {
  const auto found = std::find(table.header.begin(), table.header.end(), column);
  const auto index = static_cast<std::size_t>(found - table.header.begin());
  return index < row.size() ? row[index] : "nan";
}

TextTable from_csv(std::string_view text) {
  std::istringstream lines{std::string(text)};
  CsvRows rows(lines);
  TextTable table;
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

std::string to_text(const Table& table, std::size_t text_columns) {
  return to_text(texts_of(table), text_columns);
}

std::string to_text(const TextTable& raw, std::size_t text_columns) {
  const TextTable table = shown(raw);
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
  constexpr double beyond = 1e15;
  if (std::abs(value) >= beyond) return readable(value, 3);
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string readable(double value, int digits) {
  constexpr double most = 1e7;
  const bool is_long = std::abs(value) > 1.0 && std::abs(value) < most;
  const int whole =
      is_long ? static_cast<int>(std::to_string(std::llround(std::abs(value))).size()) : 0;
  return fmt::format("{:.{}g}", value, std::max(digits, whole));
}

std::string exact(double value) { return std::isnan(value) ? "nan" : fmt::format("{}", value); }

std::string metric(double value) { return std::isnan(value) ? "nan" : fixed(value, 6); }

double rounded(double value) { return number_in(metric(value)); }

std::string with_interval(const Interval& interval, int decimals) {
  if (std::isnan(interval.estimate)) return "–";
  if (std::isnan(interval.low)) return fixed(interval.estimate, decimals);
  return fmt::format("{} [{}, {}]", fixed(interval.estimate, decimals),
                     fixed(interval.low, decimals), fixed(interval.high, decimals));
}

}  // namespace touchdown
