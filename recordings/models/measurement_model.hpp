#pragma once

#include <filesystem>
#include <optional>

#include "estimator/models/measurement.hpp"
#include "estimator/models/metadata.hpp"

namespace touchdown::recordings {

/// Reads a measurement model from the `.npz` layout of the paper's authors: the axes `wheel_torque`
/// and `knee_torque` (N·m), and `contact_likelihood` and `no_contact_likelihood` with one row per
/// wheel torque. `P_contact` may be present; it follows from the others and is not read. The file's
/// metadata, if any, are stored in `metadata` if given.
/// Errors: `InputError`, one line: unreadable file, missing arrays (all of them), wrong shapes,
/// irregular axes, values that are not likelihoods, metadata of another model.
MeasurementModel read_measurement_model(const std::filesystem::path& path,
                                        std::optional<ModelMetadata>* metadata = nullptr);

/// Writes the same layout, which the robot's code can read, with the metadata, if any. `P_contact`
/// is included: contact over the sum of both, ½ where both are zero. Errors: `Error` when the file
/// cannot be written.
void write_measurement_model(const MeasurementModel& model, const std::filesystem::path& path,
                             const std::optional<ModelMetadata>& metadata = {});

}  // namespace touchdown::recordings
