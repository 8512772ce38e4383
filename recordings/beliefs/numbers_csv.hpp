#pragma once

#include <filesystem>
#include <functional>
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
};

/// Reads a line of names, then a line of numbers after the other; true and false are 1 and 0, lines
/// without anything are passed over. Errors: `InputError` with file:line:column for a file without
/// names, a row of another length, what is no number, and what the taker complains of.
void read_numbers_csv(const std::filesystem::path& path, const NumbersCsv& taker);

}  // namespace touchdown::recordings
