#pragma once

#include "estimator/models/metadata.hpp"

namespace touchdown {

/// The model as it is to be used, for whoever loads it without saying so: its passport has the
/// configuration of `use` where that says something, and if `use` has legs, those, the mass and the
/// robot's name; what was fitted stays. A model without a passport gets one.
/// Errors: those of `make_estimator`, though legs may be another robot's; `InputError` for legs of
/// an estimator that uses none.
ModelArrays model_for(ModelArrays arrays, const ModelUse& use);

}  // namespace touchdown
