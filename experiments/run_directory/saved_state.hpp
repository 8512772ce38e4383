#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace touchdown::experiments {

/// A number that tells contents apart quickly (XXH3), the same on every machine.
std::uint64_t checksum(std::string_view content);
/// Of a file, read in pieces. Nothing if it cannot be read.
std::optional<std::uint64_t> file_checksum(const std::filesystem::path& path);

/// Writes something to come back to: `content` under a `key` that says what it was computed from
/// and by which build. Appears whole or not at all. `key` is one line.
void write_state(const std::filesystem::path& path, std::string_view key, std::string_view content);

/// What was written there under the same key. Nothing if there is no such file, if its key is
/// another one, or if it is not whole.
std::optional<std::string> read_state(const std::filesystem::path& path, std::string_view key);

/// What somebody wrote there, under whatever key. Nothing if it is not whole.
struct SavedState {
  std::string key;
  std::string content;
};
std::optional<SavedState> read_any_state(const std::filesystem::path& path);

}  // namespace touchdown::experiments
