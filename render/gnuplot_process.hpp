#pragma once

#include <filesystem>
#include <string>

namespace touchdown {

/// Runs gnuplot on `script` in `folder` and returns the line in which it says what is wrong, or
/// nothing; warnings are not told. Errors: `Error` when gnuplot is not installed.
std::string gnuplot_complaint(const std::filesystem::path& folder, const std::string& script);

}  // namespace touchdown
