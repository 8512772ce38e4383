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

/// Writes the model as one `.npz`: the arrays that estimator/models/phase.hpp names, and the array
/// `provenance` of the bytes of "key: value" lines:
/// `bytes(npz["provenance"].astype("u1")).decode()`; the passport likewise, if there is one.
/// Errors: `Error`.
void write_phase_model(const PhaseModelFile& file, const std::filesystem::path& path,
                       const std::optional<ModelMetadata>& metadata = {});

/// The inverse: densities to single precision, all else to the bit. Errors: `InputError` that names
/// the file and what is wrong with it. What it says about itself goes to `metadata` if given.
PhaseModelFile read_phase_model(const std::filesystem::path& path,
                                std::optional<ModelMetadata>* metadata = nullptr);

}  // namespace touchdown::recordings
