#pragma once

#include <filesystem>

#include "recordings/beliefs/beliefs.hpp"

namespace touchdown::recordings {

/// What a belief file's name may end with.
inline constexpr std::array<const char*, 3> belief_extensions = {".csv", ".npz", ".mpack"};

/// Reads it by its extension. Errors: `InputError`, one line that says where and what was expected.
Beliefs read_beliefs(const std::filesystem::path& path);

}  // namespace touchdown::recordings
