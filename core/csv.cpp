#include "core/csv.hpp"

#include <algorithm>

namespace touchdown {

namespace {

/// A tab is no blank where it separates cells.
std::string_view blanks_beside(char separator) { return separator == '\t' ? " \r" : " \t\r"; }

/// The end of the quote at the beginning of a text. Two quote characters in a row stand for one.
std::size_t quote_end(std::string_view text) {
  std::size_t end = text.find('"', 1);
  while (end != std::string_view::npos && text.substr(end + 1, 1) == "\"") {
    end = text.find('"', end + 2);
  }
  return end;
}

std::string_view without_blanks(std::string_view text, std::string_view blanks) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// Bytes of value 0 end a text in messages. UTF-16 has one in every letter.
void show_zero_bytes(std::string& row) {
  for (std::size_t at = row.find('\0'); at != std::string::npos; at = row.find('\0', at)) {
    row.replace(at, 1, "\u2400");
  }
}

}  // namespace

std::string content_of(const CsvCell& cell) {
  if (!cell.is_quoted) return std::string(cell.raw);
  std::string text(cell.text);
  for (std::size_t at = text.find("\"\""); at != std::string::npos;
       at = text.find("\"\"", at + 1)) {
    text.erase(at, 1);
  }
  return text;
}

bool CsvRows::next() {
  row_.clear();
  if (!std::getline(text_, row_) && lines_read_ > 0) return false;
  is_unfinished_ = text_.eof() && !row_.empty();
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (lines_read_ == 0 && row_.starts_with(byte_order_mark)) row_.erase(0, byte_order_mark.size());
  show_zero_bytes(row_);
  line_ = ++lines_read_;
  split();
  return true;
}

void CsvRows::separate_by(char separator) {
  separator_ = separator;
  split();
}

bool CsvRows::append_line() {
  std::string more;
  if (!std::getline(text_, more)) return false;
  ++lines_read_;
  show_zero_bytes(more);
  row_ += '\n' + more;
  split();
  return true;
}

bool CsvRows::is_open() const { return std::ranges::any_of(cells_, &CsvCell::is_open); }

void CsvRows::split() {
  cells_.clear();
  const std::string_view row = row_;
  const std::string_view blanks = blanks_beside(separator_);
  std::size_t begin = 0;
  while (true) {
    const std::size_t first = std::min(row.find_first_not_of(blanks, begin), row.size());
    const bool has_quote = row.substr(first, 1) == "\"";
    const std::size_t quoted = has_quote ? quote_end(row.substr(first)) : 0;
    const bool is_open = quoted == std::string_view::npos;
    const std::size_t end =
        std::min(row.find(separator_, is_open ? first : first + quoted), row.size());
    const std::string_view raw = row.substr(begin, end - begin);
    std::string_view text = without_blanks(raw, blanks);
    const bool is_quoted = has_quote && !is_open && text.size() == quoted + 1;
    if (is_quoted) text = text.substr(1, quoted - 1);
    cells_.push_back({raw, text, first + 1, is_quoted, is_open});
    if (end == row.size()) return;
    begin = end + 1;
  }
}

}  // namespace touchdown
