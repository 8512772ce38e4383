#pragma once

#include <filesystem>
#include <string>

#include "onboard/npz.hpp"
#include "recordings/models/npy.hpp"

namespace touchdown::recordings {

/// Named arrays, as NumPy's `np.savez` keeps them in one file.
using NpzArrays = ModelArrays;
using touchdown::any_array;
using touchdown::made_of_npz;
using touchdown::npz_names;
using touchdown::NpzNeeds;
using touchdown::read_npz;

/// Which arrays are deflated, as NumPy's `savez_compressed` does it.
enum class Deflated { large, all };

/// The content of a `.npz`; the same arrays give the same bytes. `name` starts the message of an
/// `Error`.
std::string to_npz(const NpzArrays& arrays, const std::string& name, Deflated deflated);

/// Writes a `.npz` whole or not at all, its large arrays deflated. Errors: `Error`.
void write_npz(const NpzArrays& arrays, const std::filesystem::path& path);

}  // namespace touchdown::recordings
