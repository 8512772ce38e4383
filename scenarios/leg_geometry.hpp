#pragma once

#include "estimator/force/leg_geometry.hpp"
#include "models/robot_model.hpp"

namespace touchdown::scenarios {

/// The left leg of a robot as its description has it, without what deviates from it in one run:
/// what estimators that compute loads are told about a robot. Lengths (to 1 µm) and centres of mass
/// (to a thousandth) in the plane in which the leg bends; the wheel's inertia (to 1e-8 kg·m²) with
/// its rotor; masses, the whole robot's too, to 1 mg. Upkie's are exactly the estimators' defaults.
LegGeometry leg_geometry(const models::RobotModel& robot);

}  // namespace touchdown::scenarios
