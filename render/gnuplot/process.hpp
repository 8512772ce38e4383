#pragma once

#include <filesystem>
#include <string>

namespace touchdown::render {

/// Runs gnuplot on `script` in `folder`, without the user's settings and in UTC. Returns the line
/// in which gnuplot reports an error or data that it cannot read, or nothing; other warnings are
/// ignored. Errors: `Error` when gnuplot is not installed, or gets too few file descriptors.
std::string gnuplot_complaint(const std::filesystem::path& folder, const std::string& script);

/// Writes a script, runs it in its folder and returns the PNG that it draws, which has the script's
/// name. For optional figures: returns an empty path when gnuplot is not installed or cannot draw,
/// and a previous PNG then stays. Errors: `Error` when the script cannot be written.
std::filesystem::path try_gnuplot(const std::filesystem::path& script, const std::string& content);

}  // namespace touchdown::render
