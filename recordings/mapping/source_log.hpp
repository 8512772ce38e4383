#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "recordings/mapping/mapping.hpp"

namespace touchdown::recordings {

/// Returns the position of a row, for messages.
using SourceLocation = std::function<std::string()>;

/// Receives another robot's log. `wanted` selects columns from the names. `row` then receives the
/// numbers of these columns row by row; empty cells are NaN.
struct SourceLogSink {
  std::function<std::vector<SourceColumn>(const SourceNames& names)> wanted;
  std::function<void(std::span<const double> row, const SourceLocation& place)> row;
  /// Gets a line about rows that were left out; may be empty.
  std::function<void(const std::string& line)> note = {};
};

/// Reads the wanted columns of a log by its extension: comma-separated values (a line of names,
/// then a line per row) or NumPy's arrays. Errors: exceptions of the sink, and `InputError` with
/// file:line:column, or file and array, for
/// - another extension;
/// - a cell that is not a number;
/// - rows or arrays of different length, or an array without the wanted columns.
void read_source_log(const std::filesystem::path& path, const SourceLogSink& sink);

}  // namespace touchdown::recordings
