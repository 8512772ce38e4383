#pragma once

#include "estimator/bayes/measurement_model.hpp"
#include "estimator/models/arrays.hpp"

namespace touchdown {

/// Reads a measurement model in the layout of the paper's authors: the axes `wheel_torque` and
/// `knee_torque` (N·m), `contact_likelihood` and `no_contact_likelihood` with one row per wheel
/// torque. Errors: `InputError` for missing arrays (lists them all), wrong shapes, irregular axes,
/// and values that are not likelihoods.
MeasurementModel measurement_model_of(const ModelArrays& arrays);

/// The inverse, `P_contact` included: contact over the sum of both, ½ where both are zero.
ModelArrays arrays_of(const MeasurementModel& model);

}  // namespace touchdown
