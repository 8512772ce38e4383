#pragma once

#include <array>
#include <string>

#include "models/contract/contract.hpp"
#include "models/mjcf/document.hpp"
#include "models/robot_model.hpp"

namespace touchdown::models {

/// Finds the tyres. Errors: `InputError` for tyres that are not round about their wheel's axle, of
/// different radii, not on the body that the wheel's joint moves, or with a width and no sphere.
void find_tyres(RobotModel& robot, const Contract& contract);

/// Adds the spheres of the tyres' strips to the MJCF, before the tyre geoms. `robot` is compiled
/// from this MJCF.
void add_strips(MjcfDocument& document, const RobotModel& robot);

/// Finds the strips that `add_strips` added.
void find_strips(RobotModel& robot, const Contract& contract);

}  // namespace touchdown::models
