#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "recordings/models/npy.hpp"

namespace touchdown::recordings {

/// Named arrays, as NumPy's `np.savez` keeps them in one file.
using NpzArrays = std::map<std::string, NpyArray>;

/// What somebody needs of a file: how many numbers the array of this name may hold; 0 if it is not
/// needed.
using NpzNeeds = std::function<std::size_t(std::string_view name)>;

/// Whatever is there, as far as it is sensible.
std::size_t any_array(std::string_view name);

/// Reads a `.npz`, deflated or not; of an array that is not needed nothing is read. Errors:
/// `InputError`, one line that names the file and, where it matters, the array.
NpzArrays read_npz(const std::filesystem::path& path, const NpzNeeds& needs = any_array);

/// Names of the arrays in a file. Errors: as above.
std::vector<std::string> npz_names(const std::filesystem::path& path);

/// What `make` makes of the arrays that it needs of a file. Errors: those of `read_npz` and the
/// `InputError`s of `make`, which then name the file.
template <typename Make>
auto made_of_npz(const std::filesystem::path& path, const NpzNeeds& needs, const Make& make) {
  const NpzArrays arrays = read_npz(path, needs);
  try {
    return make(arrays);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

/// Errors: `InputError` that `what` lacks arrays of these names, if it does.
void require_arrays(const NpzArrays& arrays, std::string_view what, std::vector<std::string> names);

/// Which arrays are deflated, as NumPy's `savez_compressed` does it.
enum class Deflated { large, all };

/// The content of a `.npz`; the same arrays give the same bytes. `name` starts the message of an
/// `Error`.
std::string to_npz(const NpzArrays& arrays, const std::string& name, Deflated deflated);

/// Writes a `.npz` whole or not at all, its large arrays deflated. Errors: `Error`.
void write_npz(const NpzArrays& arrays, const std::filesystem::path& path);

}  // namespace touchdown::recordings
