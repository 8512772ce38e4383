#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "recordings/beliefs/beliefs.hpp"

namespace touchdown::recordings {

/// Who takes a file of comma-separated numbers: its names, then its rows in the order of the names;
/// each says what is wrong, if anything is, and in which column.
struct NumbersCsv {
  std::function<std::optional<WrongBelief>(std::span<const std::string> names)> names;
  std::function<std::optional<WrongBelief>(std::span<const double> values, std::size_t line)> row;
  /// Asked once the names are known. What stands in a column that is not needed is not looked at.
  std::function<bool(std::size_t column)> needs = {};
  /// What a cell is that nothing stands in; without it that is an error.
  std::optional<double> empty_cell = {};
};

/// Reads a line of names, then a line of numbers after the other; true and false are 1 and 0, lines
/// without anything are passed over. What stands between quotes ends on the same line, and may hold
/// commas. Errors: `InputError` with file:line:column for a file without names, a row of another
/// length, what is no number, a quote without its end, and what the taker complains of.
void read_numbers_csv(const std::filesystem::path& path, const NumbersCsv& taker);

}  // namespace touchdown::recordings
