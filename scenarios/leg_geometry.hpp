#pragma once

#include "estimator/force/leg_geometry.hpp"
#include "models/robot_model.hpp"

namespace touchdown::scenarios {

/// Geometry of a robot's left leg as its description has it, without the deviations of a run.
/// Estimators that compute loads get it. Lengths (to 1 µm) and centres of mass (to a thousandth)
/// are in the plane in which the leg bends. The wheel's inertia (to 1e-8 kg·m²) includes its rotor.
/// Rotors, viscous friction and torque limits are those of motors at the joints; closed legs have
/// theirs elsewhere. Masses, the whole robot's too, are rounded to 1 mg. Upkie's values equal the
/// estimators' defaults. A leg without a hip has a very long upper link without mass.
LegGeometry leg_geometry(const models::RobotModel& robot);

}  // namespace touchdown::scenarios
