#include "logs/log/numbers_csv.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "core/csv.hpp"
#include "core/error.hpp"
#include "core/resources.hpp"

namespace touchdown::logs {

namespace {

/// Digits alone.
std::optional<double> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc{} && end == text.data() + text.size();
  return is_number && value >= 0 ? std::optional(static_cast<double>(value)) : std::nullopt;
}

std::optional<double> number_of(std::string_view text);

/// Seconds since 1970 of a date and time as pandas and loggers write them: 2024-02-28 01:02:03.25,
/// with T instead of the blank, with or without Z.
std::optional<double> date_and_time(std::string_view text) {
  constexpr std::size_t shortest = 19;
  if (text.ends_with('Z')) text.remove_suffix(1);
  if (text.size() < shortest || text[4] != '-' || text[7] != '-' || text[13] != ':' ||
      text[16] != ':' || (text[10] != ' ' && text[10] != 'T')) {
    return std::nullopt;
  }
  const auto part = [&](std::size_t at, std::size_t size) {
    return whole_number(text.substr(at, size));
  };
  const auto year = part(0, 4);
  const auto month = part(5, 2);
  const auto day = part(8, 2);
  const auto hour = part(11, 2);
  const auto minute = part(14, 2);
  const auto second = number_of(text.substr(17));
  if (!year || !month || !day || !hour || !minute || !second) return std::nullopt;
  const std::chrono::year_month_day date(std::chrono::year(static_cast<int>(*year)),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*day)));
  if (!date.ok()) return std::nullopt;
  constexpr double seconds_per_day = 86400.0;
  constexpr double seconds_per_hour = 3600.0;
  constexpr double seconds_per_minute = 60.0;
  const auto days = static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
  return seconds_per_day * days + seconds_per_hour * *hour + seconds_per_minute * *minute + *second;
}

std::optional<double> number_of(std::string_view text) {
  if (text == "true" || text == "True") return 1.0;
  if (text == "false" || text == "False") return 0.0;
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  const std::string_view digits = text.substr(has_plus ? 1 : 0);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size()) return date_and_time(text);
  return value;
}

/// The character that separates the cells of a header: the most frequent one outside of quotes.
char separator_of(std::string_view header) {
  char best = ',';
  std::ptrdiff_t most = 0;
  for (const char candidate : {',', ';', '\t'}) {
    std::ptrdiff_t count = 0;
    bool is_quoted = false;
    for (const char c : header) {
      if (c == '"') is_quoted = !is_quoted;
      if (c == candidate && !is_quoted) ++count;
    }
    if (count > most) best = candidate;
    most = std::max(most, count);
  }
  return best;
}

bool is_comment(std::string_view row) { return row.starts_with('#') || row.starts_with('%'); }

/// Reads one row after the other, with its place for messages.
class RowReader {
 public:
  RowReader(const std::filesystem::path& path, std::istream& text, const NumbersCsvSink& sink)
      : file_(path.string()), rows_(text), sink_(sink) {}

  void read() {
    std::string comment;
    while (!(has_names_ && sink_.is_done && sink_.is_done()) && rows_.next()) {
      if (is_comment(rows_.row())) {
        comment = rows_.row();
        continue;
      }
      if (!has_names_) {
        find_names(comment);
        continue;
      }
      if (is_cut_off()) continue;
      for (const CsvCell& cell : rows_.cells()) {
        if (cell.is_open) complain(cell.column, "expected the end of a quote on the same line");
      }
      const bool is_blank = rows_.cells().size() == 1 && rows_.cells().front().text.empty();
      if (!is_blank) take_values();
    }
    if (!has_names_) take_names();  // complains about a file of comments
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

  /// The names are the first line that is no comment. Some programs, such as NumPy's savetxt, write
  /// them into a comment: then that line has numbers alone.
  void find_names(const std::string& comment) {
    separator_ = separator_of(rows_.row());
    rows_.separate_by(separator_);
    for (const CsvCell& cell : rows_.cells()) {
      if (cell.is_open) complain(cell.column, "expected the end of a quote on the same line");
    }
    const bool has_numbers_alone =
        std::all_of(rows_.cells().begin(), rows_.cells().end(),
                    [](const CsvCell& cell) { return number_of(cell.text).has_value(); });
    if (comment.empty() || !has_numbers_alone) return take_names();
    std::istringstream text(
        comment.substr(std::min(comment.size(), comment.find_first_not_of("#% "))));
    CsvRows names(text);
    names.next();
    names.separate_by(separator_);
    if (names.cells().size() != rows_.cells().size()) return take_names();
    take_names(names.cells());
    take_values();
  }

  void take_names() { take_names(rows_.cells()); }

  void take_names(const std::vector<CsvCell>& cells) {
    has_names_ = true;
    std::vector<std::string> names;
    for (const CsvCell& cell : cells) {
      names.push_back(cell.is_quoted ? content_of(cell) : std::string(cell.text));
    }
    check(sink_.names(names));
    values_.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      needed_.push_back(!sink_.needs || sink_.needs(i));
      has_text_.push_back(sink_.has_text && sink_.has_text(i));
    }
  }

  /// Whether the file ends within this row, which is then left out with a note: a logger that was
  /// switched off.
  bool is_cut_off() const {
    if (!rows_.is_unfinished() || !sink_.note) return false;
    const std::vector<CsvCell>& cells = rows_.cells();
    const CsvCell& last = cells.back();
    const bool is_whole = cells.size() >= values_.size() && !last.is_open &&
                          (last.text.empty() || !needed_.back() || number_of(last.text));
    if (is_whole) return false;
    sink_.note(fmt::format("{}:{}: the last row is cut off and was left out", file_, rows_.line()));
    return true;
  }

  void take_values() {
    const std::vector<CsvCell>& cells = rows_.cells();
    if (cells.size() != values_.size()) {
      complain(cells.back().column,
               fmt::format("expected {} values, found {}", values_.size(), cells.size()));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (needed_[i]) values_[i] = value_of(cells[i]);
      if (has_text_[i]) sink_.text(i, cells[i].text);
    }
    check(sink_.row(values_, rows_.line()));
  }

  double value_of(const CsvCell& cell) const {
    std::optional<double> value = cell.text.empty() ? sink_.empty_cell : number_of(cell.text);
    if (!value && separator_ != ',') value = number_with_comma(cell.text);
    if (!value) complain(cell.column, fmt::format("expected a number, found '{}'", cell.text));
    return *value;
  }

  /// A decimal comma, as in files with semicolons between cells.
  static std::optional<double> number_with_comma(std::string_view text) {
    std::string copy(text);
    const std::size_t comma = copy.find(',');
    if (comma == std::string::npos) return std::nullopt;
    copy[comma] = '.';
    return number_of(copy);
  }

  std::string file_;
  CsvRows rows_;
  const NumbersCsvSink& sink_;
  std::vector<double> values_;
  std::vector<bool> needed_;
  std::vector<bool> has_text_;
  char separator_ = ',';
  bool has_names_ = false;
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

}  // namespace touchdown::logs
