#pragma once

#include <filesystem>
#include <string_view>

namespace touchdown::render {

/// Writes a file that gets another name once all is well, onto the disk; errors call it by that
/// name, `becomes`. Errors: `Error` when not all of it can be written.
void write_whole(const std::filesystem::path& path, std::string_view content,
                 const std::filesystem::path& becomes);

/// Whether what another program drew ends as a file of its kind does: a PNG with its last chunk, an
/// SVG with `</svg>`, a PDF with `%%EOF`. On a full disk gnuplot writes what has room, and is
/// content.
bool is_whole(const std::filesystem::path& drawing);

/// Has what is whole on the disk. Throws `Error` if it is not whole, or cannot be flushed;
/// `becomes` as above.
void require_whole(const std::filesystem::path& drawing, const std::filesystem::path& becomes);

}  // namespace touchdown::render
