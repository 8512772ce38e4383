#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "estimator/models/arrays.hpp"

namespace touchdown {

/// Numbers as float64, or what float64 does not hold of them: a part of whole ones beyond 2^53.
enum class NpyPart { rounded, rest };

/// Reads the content of a `.npy` file as NumPy writes it: float64, float32, whole numbers or bool,
/// C order, one or two axes. Errors: `InputError` for anything else, with the line of NumPy that
/// converts it, and when bytes are missing; `name` starts the message.
ModelArray from_npy(std::string_view bytes, const std::string& name,
                    NpyPart part = NpyPart::rounded);

/// The inverse: float64, little endian, format 1.0.
std::string to_npy(const ModelArray& array);

/// Whether a caller needs the array of this name.
using NpzNeeds = std::function<bool(std::string_view name)>;

/// Reads the needed arrays of a `.npz`, deflated or not; without `needs`, all. Errors:
/// `InputError`, one line that names the file and, where it matters, the array.
ModelArrays read_npz(const std::filesystem::path& path, const NpzNeeds& needs = {},
                     NpyPart part = NpyPart::rounded);

/// Names of the arrays in a file. Errors: as above.
std::vector<std::string> npz_names(const std::filesystem::path& path);

/// The arrays that are deflated, as by NumPy's `savez_compressed`.
enum class Deflated { large, all };

/// The content of a `.npz` file. The same arrays give the same bytes. `name` is used in messages.
/// Errors: `Error`.
std::string to_npz(ModelArrays arrays, const std::string& name, Deflated deflated);

}  // namespace touchdown
