#pragma once

#include <functional>
#include <string>

#include "models/mjcf/types.hpp"

namespace touchdown::models {

/// Throws an `InputError` about a motor.
using FailAtMotor = std::function<void(const std::string& message)>;

/// The torque limit of a motor on its joint (N·m): the control range times the gain, within the
/// force range, times the gear. Position and velocity servos count with their force range. Errors:
/// `fail` for activations, limits that are not symmetric, and motors without a limit.
double torque_limit(const mjModel& model, int motor, const FailAtMotor& fail);

/// Removes the law of a position or velocity servo: MuJoCo must not add it to touchdown's. Returns
/// whether there was one.
bool remove_law(mjModel& model, int motor);

}  // namespace touchdown::models
