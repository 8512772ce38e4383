#pragma once

#include <filesystem>
#include <string>

#include "onboard/npz.hpp"
#include "recordings/models/npy.hpp"

namespace touchdown::recordings {

/// Named arrays, as in a file of NumPy's `np.savez`.
using NpzArrays = ModelArrays;
using touchdown::any_array;
using touchdown::made_of_npz;
using touchdown::npz_names;
using touchdown::NpzNeeds;
using touchdown::read_npz;

/// The arrays that are deflated, as by NumPy's `savez_compressed`.
enum class Deflated { large, all };

/// The content of a `.npz` file. The same arrays give the same bytes. `name` is used in messages.
/// Errors: `Error`.
std::string to_npz(NpzArrays arrays, const std::string& name, Deflated deflated);

/// Writes a `.npz` file completely or not at all, with large arrays deflated. Errors: `Error`.
void write_npz(NpzArrays arrays, const std::filesystem::path& path);

}  // namespace touchdown::recordings
