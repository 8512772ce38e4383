#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "recordings/models/npy.hpp"

namespace touchdown::recordings {

/// Named arrays, as NumPy's `np.savez` keeps them in one file.
using NpzArrays = std::map<std::string, NpyArray>;

/// Reads a `.npz`, deflated or not. Errors: `InputError`, one line that names the file and, where
/// it matters, the array.
NpzArrays read_npz(const std::filesystem::path& path);

/// Writes a `.npz` whole or not at all; the same arrays give the same bytes. Errors: `Error`.
void write_npz(const NpzArrays& arrays, const std::filesystem::path& path);

}  // namespace touchdown::recordings
