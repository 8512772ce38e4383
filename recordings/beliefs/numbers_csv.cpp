#include "recordings/beliefs/numbers_csv.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/csv/rows.hpp"
#include "core/error.hpp"
#include "core/resources.hpp"

namespace touchdown::recordings {

namespace {

std::optional<double> number_of(std::string_view text) {
  if (text == "true" || text == "True") return 1.0;
  if (text == "false" || text == "False") return 0.0;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Reads one row after the other, with its place for messages.
class RowReader {
 public:
  RowReader(const std::filesystem::path& path, std::istream& text, const NumbersCsvSink& sink)
      : file_(path.string()), rows_(text), sink_(sink) {}

  void read() {
    while (rows_.next()) {
      for (const CsvCell& cell : rows_.cells()) {
        if (cell.is_open) complain(cell.column, "expected the end of a quote on the same line");
      }
      const bool is_blank = rows_.cells().size() == 1 && rows_.cells().front().text.empty();
      if (rows_.line() == 1) {
        take_names();
      } else if (!is_blank) {
        take_values();
      }
    }
  }

 private:
  [[noreturn]] void complain(std::size_t column, const std::string& what) const {
    throw InputError(fmt::format("{}:{}:{}: {}", file_, rows_.line(), column, what));
  }

  void check(const std::optional<ColumnError>& wrong) const {
    if (!wrong) return;
    const std::size_t cell = std::min(wrong->column, rows_.cells().size() - 1);
    complain(rows_.cells()[cell].column, wrong->what);
  }

  void take_names() {
    std::vector<std::string> names;
    for (const CsvCell& cell : rows_.cells()) {
      names.push_back(cell.is_quoted ? content_of(cell) : std::string(cell.text));
    }
    check(sink_.names(names));
    values_.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      needed_.push_back(!sink_.needs || sink_.needs(i));
    }
  }

  void take_values() {
    const std::vector<CsvCell>& cells = rows_.cells();
    if (cells.size() != values_.size()) {
      complain(cells.back().column,
               fmt::format("expected {} values, found {}", values_.size(), cells.size()));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (needed_[i]) values_[i] = value_of(cells[i]);
    }
    check(sink_.row(values_, rows_.line()));
  }

  double value_of(const CsvCell& cell) const {
    const std::optional<double> value = cell.text.empty() ? sink_.empty_cell : number_of(cell.text);
    if (!value) complain(cell.column, fmt::format("expected a number, found '{}'", cell.text));
    return *value;
  }

  std::string file_;
  CsvRows rows_;
  const NumbersCsvSink& sink_;
  std::vector<double> values_;
  std::vector<bool> needed_;
};

}  // namespace

void read_numbers_csv(const std::filesystem::path& path, const NumbersCsvSink& sink) {
  require_file(path);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: no such file", path.string()));
  RowReader(path, file, sink).read();
  // A read error looks like the end of the file.
  if (file.bad()) throw Error(fmt::format("{}: cannot be read", path.string()));
}

}  // namespace touchdown::recordings
