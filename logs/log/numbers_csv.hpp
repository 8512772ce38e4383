#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace touchdown::logs {

/// An error in the names or in one row of a file, with its column. The reader of the file adds the
/// position.
struct ColumnError {
  std::size_t column = 0;
  std::string what;
};

/// Receives a file of comma-separated numbers: first the names, then the rows in the order of the
/// names. Each callback returns an error, if any.
struct NumbersCsvSink {
  std::function<std::optional<ColumnError>(std::span<const std::string> names)> names;
  std::function<std::optional<ColumnError>(std::span<const double> values, std::size_t line)> row;
  /// Called once the names are known. Columns that are not needed are not parsed.
  std::function<bool(std::size_t column)> needs = {};
  /// Called once the names are known: the columns of which `text` gets each cell, before `row`.
  std::function<bool(std::size_t column)> has_text = {};
  std::function<void(std::size_t column, std::string_view text)> text = {};
  /// The value of an empty cell; without it an empty cell is an error.
  std::optional<double> empty_cell = {};
  /// Gets a line about a last row that is cut off and was left out; without it that is an error.
  std::function<void(const std::string& line)> note = {};
  /// Asked after the names and after each row: the rest of the file is not read once it is true.
  std::function<bool()> is_done = {};
};

/// Reads a line of names, then lines of numbers. Cells are separated by commas, semicolons or tabs,
/// whichever the names have most. true and false are 1 and 0; a date and time (2024-02-28 01:02:03)
/// is in seconds since 1970. Empty lines, and comments from # or % on, are skipped; a comment
/// before numbers may hold the names. Quoted cells may contain commas and must end on the same
/// line. Errors: `InputError` with file:line:column for
/// - a file without names, or a row of another length;
/// - a cell that is not a number, or a quote without end;
/// - errors of the sink.
void read_numbers_csv(const std::filesystem::path& path, const NumbersCsvSink& sink);

}  // namespace touchdown::logs
