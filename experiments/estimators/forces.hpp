#pragma once

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// A threshold on each wheel's load, as teams with wheeled legs use it. It needs no fit.
EstimatorEntry support_force_entry();

/// Published estimators for legged robots, applied to wheels.
EstimatorEntry force_kinematics_entry();

}  // namespace touchdown::experiments
