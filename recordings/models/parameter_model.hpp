#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "estimator/models/parameters.hpp"
#include "estimator/models/metadata.hpp"
#include "recordings/models/provenance.hpp"

namespace touchdown::recordings {

using touchdown::parameter;
using touchdown::Parameters;

struct ParameterModelFile {
  std::string estimator;  ///< whose parameters they are
  Parameters parameters;
  ModelProvenance provenance;
};

/// Writes one `.npz`: an array for each parameter, `estimator` and `provenance` as the bytes of
/// their texts, and its passport, if it has one. Errors: `Error` when it cannot be written, and for
/// a parameter that has one of those names.
void write_parameter_model(const ParameterModelFile& file, const std::filesystem::path& path,
                           const std::optional<ModelMetadata>& metadata = {});

/// The inverse, to the bit. Errors: `InputError` that names the file: unreadable, no such model,
/// values that are not finite. What it says about itself goes to `metadata` if given.
ParameterModelFile read_parameter_model(const std::filesystem::path& path,
                                        std::optional<ModelMetadata>* metadata = nullptr);

}  // namespace touchdown::recordings
