#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "estimator/models/arrays.hpp"

namespace touchdown {

/// A source of the bytes of a `.npy` file, in order. It fills the span as far as bytes are left and
/// returns their number.
using NpyBytes = std::function<std::size_t(std::span<char>)>;

/// Reads float64, float32, whole numbers (those beyond 2^53 rounded), bool, and datetime64 and
/// timedelta64 as seconds (NaT as NaN), C and Fortran order, one or two axes, formats 1.0 to 3.0.
/// Errors: `InputError` for anything else or when bytes are missing; `name` starts the message.
ModelArray from_npy(std::string_view bytes, const std::string& name);

/// As above, from a file of `size` bytes. Errors: also for an array of more than `most` numbers,
/// before reading them.
ModelArray read_npy(const NpyBytes& bytes, std::size_t size, const std::string& name,
                    std::size_t most);

/// The content of a `.npy` file: float64, little endian, C order, format 1.0.
std::string to_npy(const ModelArray& array);

/// Which arrays of a file a caller needs: the most numbers that the array of this name may hold, 0
/// if the caller does not need it.
using NpzNeeds = std::function<std::size_t(std::string_view name)>;

/// Needs every array, up to a sensible size.
std::size_t any_array(std::string_view name);

/// Reads the needed arrays of a `.npz`, deflated or not. Errors: `InputError`, one line that names
/// the file and, where it matters, the array.
ModelArrays read_npz(const std::filesystem::path& path, const NpzNeeds& needs = any_array);

/// Names of the arrays in a file. Errors: as above.
std::vector<std::string> npz_names(const std::filesystem::path& path);

/// The arrays that are deflated, as by NumPy's `savez_compressed`.
enum class Deflated { large, all };

/// The content of a `.npz` file. The same arrays give the same bytes. `name` is used in messages.
/// Errors: `Error`.
std::string to_npz(ModelArrays arrays, const std::string& name, Deflated deflated);

}  // namespace touchdown
