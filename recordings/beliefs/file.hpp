#pragma once

#include <filesystem>

#include "recordings/beliefs/beliefs.hpp"

namespace touchdown::recordings {

/// Extensions of belief files.
inline constexpr std::array<const char*, 3> belief_extensions = {".csv", ".npz", ".mpack"};

/// Reads a belief file by its extension. Errors: `InputError` with the position and what was
/// expected.
Beliefs read_beliefs(const std::filesystem::path& path);

}  // namespace touchdown::recordings
