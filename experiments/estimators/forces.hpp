#pragma once

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// What teams with wheeled legs use, fitted to nothing.
EstimatorEntry support_force_entry();

/// Estimators for legged robots that others published, on wheels.
EstimatorEntry load_logistic_entry();
EstimatorEntry force_kinematics_entry();

}  // namespace touchdown::experiments
