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

/// What somebody needs of a file: how many numbers the array of this name may hold; 0 if it is not
/// needed.
using NpzNeeds = std::function<std::size_t(std::string_view name)>;

/// Whatever is there, as far as it is sensible.
std::size_t any_array(std::string_view name);

/// Reads a `.npz`, deflated or not; of an array that is not needed nothing is read. Errors:
/// `InputError`, one line that names the file and, where it matters, the array.
ModelArrays read_npz(const std::filesystem::path& path, const NpzNeeds& needs = any_array);

/// Names of the arrays in a file. Errors: as above.
std::vector<std::string> npz_names(const std::filesystem::path& path);

/// What `make` makes of the arrays that it needs of a file. Errors: those of `read_npz` and the
/// `InputError`s of `make`, which then name the file.
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
