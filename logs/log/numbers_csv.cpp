#include "logs/log/numbers_csv.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <ctime>
#include <sstream>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"

namespace touchdown::logs {

namespace {

template <typename Real>
std::optional<Real> number_of(std::string_view text);

/// Seconds since 1970 of a date and time as pandas and loggers write them: 2024-02-28 01:02:03.25,
/// with T instead of the blank, with or without Z or an offset such as +01:00.
template <typename Real>
std::optional<Real> date_and_time(std::string_view text) {
  constexpr std::size_t seconds_at = 17;
  constexpr std::size_t shortest = 19;
  std::string minutes(text.substr(0, seconds_at));
  if (text.size() < shortest || (minutes[10] != ' ' && minutes[10] != 'T')) {
    return std::nullopt;
  }
  minutes[10] = 'T';
  std::tm date{};
  const char* const end = ::strptime(minutes.c_str(), "%Y-%m-%dT%H:%M:", &date);
  const int day = date.tm_mday;
  const auto since_1970 = static_cast<Real>(::timegm(&date));  // moves the 30th of February
  if (text.ends_with('Z')) text.remove_suffix(1);
  constexpr std::size_t zone_width = 6;
  Real east = 0;  // s
  const std::size_t zone = text.size() - zone_width;
  if (zone > seconds_at && (text[zone] == '+' || text[zone] == '-')) {
    const auto hours = number_of<Real>(text.substr(zone + 1, 2));
    const auto minute = number_of<Real>(text.substr(zone + 4, 2));
    if (text[zone + 3] != ':' || !hours || !minute) return std::nullopt;
    east = (text[zone] == '+' ? 1 : -1) * (3600 * *hours + 60 * *minute);
    text = text.substr(0, zone);
  }
  const auto second = number_of<Real>(text.substr(seconds_at));
  if (end != minutes.c_str() + seconds_at || day != date.tm_mday || !second) return std::nullopt;
  return since_1970 - east + *second;
}

template <typename Real>
std::optional<Real> number_of(std::string_view text) {
  if (text == "true" || text == "True") return Real{1};
  if (text == "false" || text == "False") return Real{0};
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  const std::string_view digits = text.substr(has_plus ? 1 : 0);
  Real value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size())
    return date_and_time<Real>(text);
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

/// Whether a file begins with this row in UTF-16, such as Excel's "Unicode text": half of the bytes
/// of Latin letters are zero.
bool is_utf_16(std::string_view first_row) {
  if (first_row.starts_with("\xff\xfe") || first_row.starts_with("\xfe\xff")) return true;
  constexpr std::string_view zero = "\u2400";  // in `CsvRows`
  const bool begins_with_zero = first_row.starts_with(zero);
  const std::size_t second = std::min(begins_with_zero ? zero.size() : 1, first_row.size());
  return begins_with_zero != first_row.substr(second).starts_with(zero);
}

/// Whether carriage returns are within this row, not only at its end.
bool has_inner_return(std::string_view row) {
  return row.find('\r') < row.find_last_not_of('\r') + 1;
}

bool is_comment(std::string_view row) { return row.starts_with('#') || row.starts_with('%'); }

/// A decimal comma, as in files with semicolons between cells.
template <typename Real>
std::optional<Real> number_with_comma(std::string_view text) {
  std::string copy(text);
  const std::size_t comma = copy.find(',');
  if (comma == std::string::npos) return std::nullopt;
  copy[comma] = '.';
  return number_of<Real>(copy);
}

std::ifstream opened(const std::filesystem::path& path) {
  require_file(path);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) complain_unreadable(path.string(), {errno, std::generic_category()}, "opened");
  return file;
}

}  // namespace

NumbersCsv::NumbersCsv(const std::filesystem::path& path, const Config& config)
    : file_(path.string()), config_(config), stream_(opened(path)), rows_(stream_) {
  std::string comment;
  bool has_line = false;
  while (!has_line && rows_.next()) {
    require_lines();
    has_line = !is_comment(rows_.row());
    if (!has_line) comment = rows_.row();
  }
  if (has_line) {
    find_names(comment);
  } else {
    take_names(rows_.cells());  // of a file of comments: no reader takes it
  }
}

/// The names are the first line that is no comment. Some programs, such as NumPy's savetxt, write
/// them into a comment: then that line has numbers alone.
void NumbersCsv::find_names(const std::string& comment) {
  separator_ = separator_of(rows_.row());
  rows_.separate_by(separator_);
  require_closed_quotes();
  require_known_separator();
  const bool has_numbers_alone = std::ranges::all_of(
      rows_.cells(), [](const CsvCell& cell) { return number_of<double>(cell.text).has_value(); });
  if (comment.empty() || !has_numbers_alone) return take_names(rows_.cells());
  std::istringstream text(
      comment.substr(std::min(comment.size(), comment.find_first_not_of("#% "))));
  CsvRows names(text);
  names.next();
  names.separate_by(separator_);
  has_row_ = names.cells().size() == rows_.cells().size();
  take_names(has_row_ ? names.cells() : rows_.cells());
}

/// Errors: `InputError` for an encoding, or line ends, with which no line has the names.
void NumbersCsv::require_lines() const {
  if (rows_.line() == 1 && is_utf_16(rows_.row())) {
    throw InputError(fmt::format("{}: is UTF-16: save it as UTF-8", file_));
  }
  if (has_inner_return(rows_.row())) {
    throw InputError(fmt::format(
        "{}: its lines end with CR alone: save it with the line ends LF or CR LF", file_));
  }
}

/// Errors: `InputError` for a line that is one cell, but has blanks or bars between its words.
void NumbersCsv::require_known_separator() const {
  const std::vector<CsvCell>& cells = rows_.cells();
  if (cells.size() > 1 || cells.front().is_quoted) return;
  const std::string_view line = cells.front().text;
  const char found = line.find('|') != std::string_view::npos ? '|' : ' ';
  const std::size_t at = line.find(found);
  if (at == std::string_view::npos) return;
  complain_at(cells.front().column + at,
              fmt::format("expected commas, semicolons or tabs between columns, found {}",
                          found == ' ' ? "blanks" : "'|'"));
}

void NumbersCsv::take_names(const std::vector<CsvCell>& cells) {
  for (const CsvCell& cell : cells) {
    names_.push_back(cell.is_quoted ? content_of(cell) : std::string(cell.text));
  }
  values_.resize(names_.size());
  needed_.assign(names_.size(), true);
}

bool NumbersCsv::next() {
  while (has_row_ || rows_.next()) {
    if (!has_row_) {
      if (is_comment(rows_.row()) || is_cut_off()) continue;
      require_closed_quotes();
      const bool is_blank = rows_.cells().size() == 1 && rows_.cells().front().text.empty();
      if (is_blank) continue;
    }
    has_row_ = false;
    take_values();
    return true;
  }
  // A read error looks like the end of the file.
  if (stream_.bad()) throw Error(fmt::format("{}: cannot be read", file_));
  return false;
}

void NumbersCsv::require_closed_quotes() const {
  for (const CsvCell& cell : rows_.cells()) {
    if (cell.is_open) complain_at(cell.column, "expected the end of a quote on the same line");
  }
}

/// Whether the file ends within this row, which is then left out with a note: a logger that was
/// switched off.
bool NumbersCsv::is_cut_off() {
  if (!rows_.is_unfinished() || !config_.may_be_cut_off) return false;
  const std::vector<CsvCell>& cells = rows_.cells();
  const CsvCell& last = cells.back();
  const bool is_whole = cells.size() >= values_.size() && !last.is_open &&
                        (last.text.empty() || !needed_.back() || number_of<double>(last.text));
  if (is_whole) return false;
  note_ = fmt::format("{}:{}: the last row is cut off and was left out", file_, rows_.line());
  return true;
}

void NumbersCsv::take_values() {
  const std::vector<CsvCell>& cells = rows_.cells();
  if (cells.size() != values_.size()) {
    complain_at(cells.back().column, fmt::format("expected {} values, found {}{}", values_.size(),
                                                 cells.size(), decimal_comma_hint()));
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (needed_[i]) values_[i] = value_of<double>(cells[i]);
  }
}

/// A question, if this row may have too many cells because its numbers have decimal commas.
std::string NumbersCsv::decimal_comma_hint() const {
  const std::vector<CsvCell>& cells = rows_.cells();
  const bool are_parts = std::ranges::all_of(cells, [](const CsvCell& cell) {
    return cell.text.find('.') == std::string_view::npos && number_of<double>(cell.text);
  });
  if (separator_ != ',' || cells.size() <= values_.size() || !are_parts) return {};
  return ": do the numbers have a decimal comma? Write points, or separate the columns by "
         "semicolons or tabs";
}

double NumbersCsv::rest(std::size_t column) const {
  const long double exact = value_of<long double>(rows_.cells()[column]);
  return static_cast<double>(exact - static_cast<long double>(values_[column]));
}

template <typename Real>
Real NumbersCsv::value_of(const CsvCell& cell) const {
  std::optional<Real> value;
  if (!cell.text.empty()) {
    value = number_of<Real>(cell.text);
  } else if (config_.empty_cell) {
    value = *config_.empty_cell;
  }
  if (!value && separator_ != ',') value = number_with_comma<Real>(cell.text);
  if (!value) {
    const bool has_comma = number_with_comma<Real>(cell.text).has_value();
    complain_at(cell.column,
                fmt::format("expected a number, found '{}'{}", cell.text,
                            has_comma ? ": a decimal comma is read only where semicolons or tabs "
                                        "separate the columns"
                                      : ""));
  }
  return *value;
}

void NumbersCsv::complain(std::size_t column, const std::string& what) const {
  complain_at(rows_.cells()[std::min(column, rows_.cells().size() - 1)].column, what);
}

void NumbersCsv::complain_at(std::size_t column, const std::string& what) const {
  throw InputError(fmt::format("{}:{}:{}: {}", file_, rows_.line(), column, what));
}

}  // namespace touchdown::logs
