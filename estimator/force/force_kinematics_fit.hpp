#pragma once

#include <span>

#include "estimator/force/force_kinematics.hpp"
#include "estimator/labelled_run.hpp"

namespace touchdown {

/// Lower bounds of the fitted deviations, and of the rate at which a state is left.
struct ForceKinematicsFloors {
  double force = 1.0;           ///< N
  double axle_velocity = 0.02;  ///< m/s
  double leaving_rate = 0.1;    ///< 1/s
};

/// Fits the model of `ForceKinematics` to the measured steps of both wheels of all runs, each run
/// at its own rate. It takes means, standard deviations (about zero where the mean is zero), and
/// how often a wheel left a state per second in it. Errors: `InputError` for runs that lack one of
/// the states, and for labels that are not one per step.
[[nodiscard]] ForceKinematicsModel fit_force_kinematics(std::span<const LabelledRun> runs,
                                                        const ForceKinematicsConfig& config = {},
                                                        const ForceKinematicsFloors& floors = {});

}  // namespace touchdown
