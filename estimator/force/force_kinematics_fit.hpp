#pragma once

#include <span>

#include "estimator/force/force_kinematics.hpp"
#include "estimator/labelled_run.hpp"

namespace touchdown {

/// No state is taken for narrower than this, and none for one that lasts longer.
struct ForceKinematicsFloors {
  double force = 1.0;           ///< N
  double axle_velocity = 0.02;  ///< m/s
  double leaving_rate = 0.1;    ///< 1/s
};

/// The model that `ForceKinematics` needs, from the steps of both wheels of all runs at which it
/// would be measured; each run is heard at its own rate. Means, standard deviations (about zero
/// where the mean is), and how often a state was left for each second in it. Errors: `InputError`
/// for runs that lack one of the states and for labels that are not one per step.
[[nodiscard]] ForceKinematicsModel fit_force_kinematics(std::span<const LabelledRun> runs,
                                                        const ForceKinematicsConfig& config = {},
                                                        const ForceKinematicsFloors& floors = {});

}  // namespace touchdown
