#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/faults/injection.hpp"

namespace touchdown::faults {

/// Every file of a run directory under its final name, by its path there, and its content; of the
/// manifest and the report, which say when and how they were made, whether they are whole. Not the
/// lock, in which everybody signs.
using Files = std::map<std::string, std::string>;
Files files_of(const std::filesystem::path& directory);
/// What processes left half written.
std::vector<std::string> parts_in(const std::filesystem::path& directory);

/// What is wrong with how a disturbed program ended, one line each: a file that is neither whole
/// nor absent, success without all files, a complaint that is not one line or does not name what
/// was refused.
std::vector<std::string> wrong_in(const cli::Ended& ended, const Injection& injection,
                                  const Files& left, const Files& expected);

/// What is neither absent nor whole, of files that are written once.
std::vector<std::string> half_written(const Files& left, const Files& expected);

/// The same of the same command without a disturbance.
std::vector<std::string> wrong_after(const cli::Ended& again,
                                     const std::filesystem::path& directory, const Files& expected);

}  // namespace touchdown::faults
