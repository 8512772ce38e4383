#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "recordings/mapping/mapping.hpp"

namespace touchdown::recordings {

/// Names a row in complaints.
using SourceLocation = std::function<std::string()>;

/// Who reads a foreign log: told its names, it says which columns it wants, and then gets row after
/// row the numbers of these, NaN for a cell that is empty.
struct SourceLogSink {
  std::function<std::vector<SourceColumn>(const SourceNames& names)> wanted;
  std::function<void(std::span<const double> row, const SourceLocation& place)> row;
};

/// Reads a log as comma-separated values (a line of names, then a line per row) or as NumPy's
/// arrays, by its extension. Nothing else than what is wanted is looked at. Errors: `InputError`
/// with file:line:column, or file and array, for another extension, what is no number, rows or
/// arrays that differ in length, and an array that has not the wanted columns; whatever the taker
/// throws.
void read_source_log(const std::filesystem::path& path, const SourceLogSink& taker);

}  // namespace touchdown::recordings
