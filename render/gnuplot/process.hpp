#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace touchdown::render {

/// Writes and flushes a file that will be renamed to `final_path` when all files are complete.
/// Errors: `Error`, naming `final_path`, when the file cannot be written in full.
void write_whole(const std::filesystem::path& path, std::string_view content,
                 const std::filesystem::path& final_path);

/// Flushes a complete drawing to the disk. On a full disk gnuplot writes an incomplete file and
/// reports no error. Errors: `Error`, naming `final_path`, when the drawing is incomplete or cannot
/// be flushed.
void require_whole(const std::filesystem::path& drawing, const std::filesystem::path& final_path);

/// The name of a file in the same folder as gnuplot takes it, on its command line and in scripts: a
/// name that does not begin with a letter or a digit could be an option, a data block or a
/// command that gnuplot runs.
std::string file_argument(const std::string& name);

/// Runs gnuplot on `script` in `folder`, without the user's settings and in UTC. Returns the line
/// in which gnuplot reports an error or data that it cannot read, or nothing; other warnings are
/// ignored. Errors: `Error` when gnuplot is not installed, or gets too few file descriptors.
std::string gnuplot_complaint(const std::filesystem::path& folder, const std::string& script);

}  // namespace touchdown::render
