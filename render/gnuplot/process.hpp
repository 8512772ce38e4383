#pragma once

#include <filesystem>
#include <string>

namespace touchdown::render {

/// Runs gnuplot on `script` in `folder`, with nobody's own settings and at no place of the earth,
/// and returns the line in which it says what is wrong, or nothing; warnings are not told. Errors:
/// `Error` when gnuplot is not installed.
std::string gnuplot_complaint(const std::filesystem::path& folder, const std::string& script);

/// Writes a script, runs it in its folder and returns the PNG that it draws, named like it: for a
/// figure that nothing depends on. Empty where gnuplot is not installed or cannot draw it; one that
/// was there before then stays.
/// Errors: `Error` when the script cannot be written.
std::filesystem::path try_gnuplot(const std::filesystem::path& script, const std::string& content);

}  // namespace touchdown::render
