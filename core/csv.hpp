#pragma once

#include <cstddef>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace touchdown {

/// A cell of comma-separated values.
struct CsvCell {
  std::string_view raw;    ///< as in the file, with quotes and blanks around
  std::string_view text;   ///< without quotes or blanks around
  std::size_t column = 1;  ///< of its first character that is no blank, from 1
  bool is_quoted = false;  ///< whether quotes are around the text
  bool is_open = false;    ///< whether it begins with a quote without end
};

/// The text of a quoted cell, in which two quote characters stand for one, otherwise the raw cell.
std::string content_of(const CsvCell& cell);

/// Reads comma-separated values (RFC 4180) row by row, or values with another separator. A byte
/// order mark at the beginning is left out, and bytes of value 0 become ␀ (U+2400). An empty text
/// has one row with one empty cell.
class CsvRows {
 public:
  /// `text` must outlive the object.
  explicit CsvRows(std::istream& text) : text_(text) {}

  /// Proceeds to the next line. Returns false at the end.
  bool next();
  /// Appends the next line to the row, for quotes with line ends in them. Returns false at the end.
  bool append_line();

  /// Splits this row, and those that follow, at another character: ';' or a tab.
  void separate_by(char separator);

  /// The row as it is in the file, until the next call.
  std::string_view row() const { return row_; }
  /// Whether the file ends within the row, without a line end: it may be cut off.
  bool is_unfinished() const { return is_unfinished_; }

  /// Cells of the row, until the next call.
  const std::vector<CsvCell>& cells() const { return cells_; }
  /// Number of the row's first line, from 1.
  std::size_t line() const { return line_; }
  /// Whether a cell of the row has a quote without end.
  bool is_open() const;

 private:
  void split();

  std::istream& text_;
  std::string row_;
  std::vector<CsvCell> cells_;
  std::size_t line_ = 0;
  std::size_t lines_read_ = 0;
  char separator_ = ',';
  bool is_unfinished_ = false;
};

}  // namespace touchdown
