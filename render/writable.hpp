#pragma once

#include <filesystem>

namespace touchdown {

/// Throws `Error` if no file can be made at `path`: better before an hour of work than after.
void require_writable(const std::filesystem::path& path);

}  // namespace touchdown
