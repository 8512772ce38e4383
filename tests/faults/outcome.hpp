#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/cli/started_program.hpp"
#include "tests/faults/injection.hpp"

namespace touchdown::faults {

/// The files of a run directory by path, with their content. Of the manifest and the report, which
/// contain times, only whether they are complete. Partial files and the lock are left out.
using Files = std::map<std::string, std::string>;
Files files_of(const std::filesystem::path& directory);
/// Partial files and folders that processes left.
std::vector<std::string> parts_in(const std::filesystem::path& directory);

/// Errors in how a disturbed program ended, one line each: a file that is neither whole nor absent,
/// success without all files, an error message that is not one line or does not name the refused
/// file.
std::vector<std::string> wrong_in(const cli::Ended& ended, const Injection& injection,
                                  const Files& left, const Files& expected);

/// Files that are neither absent nor whole, of those that are written once.
std::vector<std::string> half_written(const Files& left, const Files& expected);

/// Errors after the same command has run again without faults.
std::vector<std::string> wrong_after(const cli::Ended& again,
                                     const std::filesystem::path& directory, const Files& expected);

}  // namespace touchdown::faults
