#pragma once

#include <filesystem>

#include "estimator/measurement_model.hpp"

namespace touchdown {

/// Writes a measurement model as NumPy arrays under the names that the paper's authors use:
/// `wheel_torque`, `knee_torque` (the axes, N·m), `contact_likelihood`, `no_contact_likelihood` and
/// `P_contact`, the last three with one row per wheel torque.
void write_measurement_model(const MeasurementModel& model, const std::filesystem::path& path);

/// Reads such a file, ours or the authors'. Errors: `InputError`.
MeasurementModel read_measurement_model(const std::filesystem::path& path);

}  // namespace touchdown
