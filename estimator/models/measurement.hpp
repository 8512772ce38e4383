#pragma once

#include "estimator/bayes/measurement_model.hpp"
#include "estimator/models/arrays.hpp"

namespace touchdown {

/// A measurement model from the layout of the paper's authors: the axes `wheel_torque` and
/// `knee_torque` (N·m), `contact_likelihood` and `no_contact_likelihood` with one row per wheel
/// torque. Errors: `InputError`: missing arrays (all of them), wrong shapes, irregular axes, values
/// that are no likelihoods.
MeasurementModel measurement_model_of(const ModelArrays& arrays);

/// The inverse, `P_contact` included: contact over the sum of both, ½ where both are zero.
ModelArrays arrays_of(const MeasurementModel& model);

}  // namespace touchdown
