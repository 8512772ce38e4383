#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "estimator/models/metadata.hpp"
#include "estimator/models/parameters.hpp"
#include "recordings/models/provenance.hpp"

namespace touchdown::recordings {

using touchdown::parameter;
using touchdown::Parameters;

struct ParameterModelFile {
  std::string estimator;  ///< the estimator with these parameters
  Parameters parameters;
  ModelProvenance provenance;
};

/// Writes one `.npz` file: an array for each parameter, `estimator` and `provenance` as the bytes
/// of their texts, and the metadata, if any. Errors: `Error` when the file cannot be written, and
/// for a parameter with one of those names.
void write_parameter_model(const ParameterModelFile& file, const std::filesystem::path& path,
                           const std::optional<ModelMetadata>& metadata = {});

/// The inverse, to the bit. The file's metadata are stored in `metadata` if given. Errors:
/// `InputError` that names the file: unreadable, not such a model, values that are not finite.
ParameterModelFile read_parameter_model(const std::filesystem::path& path,
                                        std::optional<ModelMetadata>* metadata = nullptr);

}  // namespace touchdown::recordings
