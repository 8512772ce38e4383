#pragma once

#include "models/contract/contract.hpp"
#include "models/robot_model.hpp"

namespace touchdown::models {

/// Whether the leg called left is on the right. Errors: `InputError` unless the tyres are side by
/// side.
bool sides_are_swapped(const RobotModel& robot, const Contract& contract);

/// Changes a compiled model to touchdown's conventions (docs/guides/robots.md), whatever its file's
/// are. Recordings, policies and estimators then need to know no other.
/// - Axes: hips and knees turn forward about −y (left) and +y (right); wheels drive forward about
///   +y (left) and −y (right).
/// - Zeros: at zero, both links of a leg point straight down.
/// - IMU: x back, y left, z down, at its own place.
/// - Contacts: the robot's parts meet the terrain and not each other. The terrain's parameters
///   count. Joint limits are MuJoCo's defaults.
/// Errors: `InputError` for joints that do not turn about the base's y axis, legs that are no open
/// chain of hip, knee and wheel, or shapes that not every engine has.
void apply_conventions(RobotModel& robot, const Contract& contract);

}  // namespace touchdown::models
