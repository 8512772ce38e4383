#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/csv.hpp"

namespace touchdown::logs {

/// Reads a line of names, then lines of numbers. Cells are separated by commas, semicolons or tabs,
/// whichever the names have most. true and false are 1 and 0; a date and time (2024-02-28 01:02:03)
/// is in seconds since 1970. Empty lines, and comments from # or % on, are skipped; a comment
/// before numbers may hold the names. Quoted cells may contain commas and must end on the same
/// line. Errors: `InputError` with file:line:column for
/// - UTF-16, lines that end with CR alone, or columns with blanks or '|' between them;
/// - a file without names, or a row of another length;
/// - a cell that is not a number, or a quote without end.
class NumbersCsv {
 public:
  struct Config {
    std::optional<double> empty_cell = {};  ///< its value; without one an empty cell is an error
    /// Whether a last row that is cut off is left out with a `note`; otherwise it is an error.
    bool may_be_cut_off = false;
  };

  /// Reads the names.
  explicit NumbersCsv(const std::filesystem::path& path, const Config& config);
  explicit NumbersCsv(const std::filesystem::path& path) : NumbersCsv(path, Config{}) {}

  const std::vector<std::string>& names() const { return names_; }
  /// Parses only the columns with true from now on; there is a flag for each.
  void select(std::vector<bool> needed) { needed_ = std::move(needed); }

  /// Proceeds to the next row. Returns false at the end.
  bool next();
  /// The numbers of the row, in the order of the names.
  std::span<const double> values() const { return values_; }
  /// What a double does not hold of the number in this column of the row.
  double rest(std::size_t column) const;
  std::string_view text(std::size_t column) const { return rows_.cells()[column].text; }
  std::size_t line() const { return rows_.line(); }
  /// A line about a row that was left out, if there is one.
  const std::string& note() const { return note_; }

  /// Errors: `InputError` at a column of this row, or of the names before the first row.
  [[noreturn]] void complain(std::size_t column, const std::string& what) const;

 private:
  void find_names(const std::string& comment);
  void require_lines() const;
  void require_known_separator() const;
  void take_names(const std::vector<CsvCell>& cells);
  void require_closed_quotes() const;
  std::string decimal_comma_hint() const;
  bool is_cut_off();
  void take_values();
  template <typename Real>
  Real value_of(const CsvCell& cell) const;
  [[noreturn]] void complain_at(std::size_t column, const std::string& what) const;

  std::string file_;
  Config config_;
  std::ifstream stream_;
  CsvRows rows_;
  std::vector<std::string> names_;
  std::vector<bool> needed_;
  std::vector<double> values_;
  std::string note_;
  char separator_ = ',';
  bool has_row_ = false;  ///< the row that was read to find the names has numbers
};

}  // namespace touchdown::logs
