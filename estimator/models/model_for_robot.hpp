#pragma once

#include "estimator/models/metadata.hpp"

namespace touchdown {

/// Writes `use` into the model's metadata, so that programs need not repeat it when they load the
/// model: the members of the configuration and, if `use` has legs, those, the mass and the robot's
/// name. The fitted numbers stay. A model without metadata gets them.
/// Errors: those of `make_estimator`, but legs may be another robot's; `InputError` for legs and an
/// estimator that uses none.
ModelArrays model_for(ModelArrays arrays, const ModelUse& use);

}  // namespace touchdown
