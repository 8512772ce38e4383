#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace touchdown::experiments {

/// Errors: `Error` when the disk that holds the directory has fewer bytes free than `needed`, with
/// what they are for. Before anything is computed is the time to say so.
void require_free_space(const std::filesystem::path& directory, std::uintmax_t needed,
                        const std::string& what_for = "");

}  // namespace touchdown::experiments
