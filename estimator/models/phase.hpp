#pragma once

#include "estimator/models/arrays.hpp"
#include "estimator/phase/model.hpp"

namespace touchdown {

/// The arrays of a phase model: `sample_rate`, `transition` (11 × 11), `seconds`, and for each
/// noise level i `torque_i_knee` and `torque_i_wheel` (lower and upper end, number of points),
/// `torque_i_log_density` (one row per cell, wheel by wheel, one column per phase),
/// `acceleration_i_axis`, `acceleration_i_log_density`, and `…_noise` = (σ, bandwidth).
ModelArrays arrays_of(const PhaseModel& model);

/// The inverse: densities to single precision, all else to the bit. Errors: `InputError` for arrays
/// that are missing or of the wrong size, and if `check_phase_model` throws.
PhaseModel phase_model_of(const ModelArrays& arrays);

}  // namespace touchdown
