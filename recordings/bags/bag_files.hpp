#pragma once

#include <filesystem>
#include <vector>

namespace touchdown::recordings {

/// The files of a bag in their order: those of `metadata.yaml`, or without it, as after a crash of
/// the recorder, the folder's `.mcap` or `.db3` files by number; a bare file is its own list.
/// Errors: `InputError` for a folder without such files, or with one missing.
std::vector<std::filesystem::path> bag_files(const std::filesystem::path& path);

/// The extension in lower case, without `.zstd`: ".mcap", ".db3", ".bag" or another one.
std::string bag_extension(const std::filesystem::path& file);

}  // namespace touchdown::recordings
