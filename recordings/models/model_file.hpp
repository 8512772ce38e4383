#pragma once

#include <filesystem>
#include <optional>

#include "estimator/models/metadata.hpp"
#include "recordings/models/npz.hpp"

namespace touchdown::recordings {

/// Longer than any text in a model.
inline constexpr std::size_t most_text = std::size_t{1} << 20U;

/// What `make` makes of a model's file; the file's passport, or that it has none, goes to
/// `metadata` if given. Errors: `InputError` that names the file.
template <typename Make>
auto read_model(const std::filesystem::path& path, const NpzNeeds& needs,
                std::optional<ModelMetadata>* metadata, const Make& make) {
  return made_of_npz(path, needs, [&](const NpzArrays& arrays) {
    // Read in any case: numbers that were changed are no model.
    std::optional<ModelMetadata> written = metadata_of(arrays);
    if (metadata != nullptr) *metadata = std::move(written);
    return make(arrays);
  });
}

/// Writes the model of one file to another, as it is to be used (estimator/models/model_for_robot.hpp),
/// with whatever else the file holds. Returns its passport. Errors: `InputError` that names the
/// file that is read, `Error` for one that cannot be written.
ModelMetadata copy_model(const std::filesystem::path& from, const std::filesystem::path& to,
                         const ModelUse& use);

/// Writes a model's arrays, with its passport if it has one. Errors: `Error`.
void write_model(NpzArrays arrays, const std::filesystem::path& path,
                 const std::optional<ModelMetadata>& metadata);

}  // namespace touchdown::recordings
