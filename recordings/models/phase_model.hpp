#pragma once

#include <filesystem>

#include "estimator/phase/model.hpp"
#include "recordings/models/provenance.hpp"

namespace touchdown::recordings {

struct PhaseModelFile {
  PhaseModel model;
  ModelProvenance provenance;
};

/// Writes the model as one `.npz`: `sample_rate`, `transition` (11 × 11), `seconds`, and for each
/// noise level i `torque_i_knee` and `torque_i_wheel` (lower and upper end, number of points),
/// `torque_i_log_density` (one row per cell, wheel by wheel, one column per phase),
/// `acceleration_i_axis`, `acceleration_i_log_density`, and `…_noise` = (σ, bandwidth). The
/// provenance is the array `provenance` of the bytes of "key: value" lines:
/// `bytes(npz["provenance"].astype("u1")).decode()`. Errors: `Error`.
void write_phase_model(const PhaseModelFile& file, const std::filesystem::path& path);

/// The inverse: densities to single precision, all else to the bit. Errors: `InputError` that names
/// the file and what is wrong with it.
PhaseModelFile read_phase_model(const std::filesystem::path& path);

}  // namespace touchdown::recordings
