#pragma once

#include <filesystem>

#include "recordings/beliefs/beliefs.hpp"

namespace touchdown::recordings {

/// Reads beliefs as NumPy's arrays, one per name and of equal length. Errors: `InputError` that
/// names the file, the array and the index.
Beliefs read_belief_npz(const std::filesystem::path& path);

}  // namespace touchdown::recordings
