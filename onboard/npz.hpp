#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "estimator/models/arrays.hpp"

namespace touchdown {

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

/// Reads the needed arrays of a file and returns what `make` makes of them. Errors: those of
/// `read_npz`, and the `InputError`s of `make`, with the file's name in front.
template <typename Make>
auto made_of_npz(const std::filesystem::path& path, const NpzNeeds& needs, const Make& make) {
  const ModelArrays arrays = read_npz(path, needs);
  try {
    return make(arrays);
  } catch (const InputError& error) {
    throw InputError(path.string() + ": " + error.what());
  }
}

}  // namespace touchdown
