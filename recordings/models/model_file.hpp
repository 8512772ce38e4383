#pragma once

#include <filesystem>
#include <optional>

#include "estimator/models/metadata.hpp"
#include "recordings/models/npz.hpp"

namespace touchdown::recordings {

/// Longer than any text in a model.
inline constexpr std::size_t most_text = std::size_t{1} << 20U;

/// Reads a model file and converts its arrays by `make`. The file's metadata, empty if there are
/// none, are stored in `metadata` if given. Errors: `InputError` that names the file.
template <typename Make>
auto read_model(const std::filesystem::path& path, const NpzNeeds& needs,
                std::optional<ModelMetadata>* metadata, const Make& make) {
  return made_of_npz(path, needs, [&](const NpzArrays& arrays) {
    // Always read: this checks the fingerprint of the arrays.
    std::optional<ModelMetadata> written = metadata_of(arrays);
    if (metadata != nullptr) *metadata = std::move(written);
    return make(arrays);
  });
}

/// Copies a model file, adapted by `use` (estimator/models/model_for_robot.hpp), with everything
/// else in it. Returns the metadata of the copy. Errors: `InputError` that names the file read,
/// `Error` if the copy cannot be written.
ModelMetadata copy_model(const std::filesystem::path& from, const std::filesystem::path& to,
                         const ModelUse& use);

/// Writes a model's arrays, with the metadata, if any. Errors: `Error`.
void write_model(NpzArrays arrays, const std::filesystem::path& path,
                 const std::optional<ModelMetadata>& metadata);

}  // namespace touchdown::recordings
