#pragma once

#include <cstdint>
#include <filesystem>

namespace touchdown::experiments {

/// Errors: `Error` when the disk that holds the directory has fewer bytes free than `needed`.
/// Before anything is computed is the time to say so.
void require_free_space(const std::filesystem::path& directory, std::uintmax_t needed);

}  // namespace touchdown::experiments
