#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace touchdown::experiments {

/// A fast checksum (XXH3), the same on every machine.
std::uint64_t checksum(std::string_view content);
/// The checksum of a file, read in blocks. Nothing if it cannot be read.
std::optional<std::uint64_t> file_checksum(const std::filesystem::path& path);

/// Saves `content` under a `key` of one line, which names its inputs and the build. The file
/// appears whole or not at all.
void write_state(const std::filesystem::path& path, std::string_view key, std::string_view content);

/// The content that was saved under this key. Nothing if the file is missing or damaged, or has
/// another key.
std::optional<std::string> read_state(const std::filesystem::path& path, std::string_view key);

/// The content of a state file, with its key.
struct SavedState {
  std::string key;
  std::string content;
};
/// Reads a state file with any key. Nothing if it is missing or damaged.
std::optional<SavedState> read_any_state(const std::filesystem::path& path);

}  // namespace touchdown::experiments
