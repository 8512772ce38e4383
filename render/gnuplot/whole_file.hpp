#pragma once

#include <filesystem>
#include <string_view>

namespace touchdown::render {

/// Writes and flushes a file that will be renamed to `final_path` when all files are complete.
/// Errors: `Error`, naming `final_path`, when the file cannot be written in full.
void write_whole(const std::filesystem::path& path, std::string_view content,
                 const std::filesystem::path& final_path);

/// Whether a drawing of another program ends as its file type does: a PNG with its last chunk, an
/// SVG with `</svg>`, a PDF with `%%EOF`. On a full disk gnuplot writes an incomplete file and
/// reports no error.
bool is_whole(const std::filesystem::path& drawing);

/// Flushes a complete drawing to the disk. Errors: `Error`, naming `final_path`, when the drawing
/// is incomplete or cannot be flushed.
void require_whole(const std::filesystem::path& drawing, const std::filesystem::path& final_path);

}  // namespace touchdown::render
