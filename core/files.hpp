#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace touchdown {

/// Write a file whole or not at all: `write` fills a temporary file beside `path`, which is renamed
/// over `path` only when `write` returned and the data is on the disk. Missing folders are made.
/// Errors: `Error` when the file cannot be written; whatever `write` throws.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// As above, with the whole content at hand.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// The whole file. Errors: `InputError` when it cannot be read.
std::string read_file(const std::filesystem::path& path);

}  // namespace touchdown
