#pragma once

#include <filesystem>
#include <optional>

#include "estimator/models/metadata.hpp"
#include "estimator/phase/model.hpp"
#include "recordings/models/provenance.hpp"

namespace touchdown::recordings {

struct PhaseModelFile {
  PhaseModel model;
  ModelProvenance provenance;
};

/// Writes the model as one `.npz` file: the arrays that estimator/models/phase.hpp names, and the
/// array `provenance` with the bytes of "key: value" lines. Python reads it by
/// `bytes(npz["provenance"].astype("u1")).decode()`. The metadata, if any, are stored likewise.
/// Errors: `Error`.
void write_phase_model(const PhaseModelFile& file, const std::filesystem::path& path,
                       const std::optional<ModelMetadata>& metadata = {});

/// The inverse: densities to single precision, everything else to the bit. The file's metadata are
/// stored in `metadata` if given. Errors: `InputError` that names the file and its error.
PhaseModelFile read_phase_model(const std::filesystem::path& path,
                                std::optional<ModelMetadata>* metadata = nullptr);

}  // namespace touchdown::recordings
