#pragma once

#include <array>
#include <string>

#include "models/contract/contract.hpp"
#include "models/mjcf/document.hpp"
#include "models/robot_model.hpp"

namespace touchdown::models {

/// Finds the tyres. Errors: `InputError` for tyres that are not round about their wheel's axle, of
/// different radii, or not on the body that the wheel's joint moves.
void find_tyres(RobotModel& robot, const Contract& contract);

/// Adds the spheres of the tyres' strips to the MJCF, before the tyre geoms. `robot` is compiled
/// from this MJCF. Errors: `InputError` if a tyre is not a sphere.
void add_strips(MjcfDocument& document, const RobotModel& robot, const Contract& contract);

/// Finds the strips that `add_strips` added.
void find_strips(RobotModel& robot, const Contract& contract);

}  // namespace touchdown::models
