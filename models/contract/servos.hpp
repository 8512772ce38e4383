#pragma once

#include "models/contract/contract.hpp"
#include "models/robot_model.hpp"

namespace touchdown::models {

/// Finds the floating base, the servos' joints and the torque limits of their motors, and checks
/// them. The limit is the control range times the gain, within the force range, times the gear.
/// Motors that are position or velocity servos count with their force range; their own laws are
/// removed. Errors: `InputError` for anything that would act besides the servos: other joints,
/// springs, several motors on a joint, activations; and for limits that are not symmetric.
void find_servos(RobotModel& robot, const Contract& contract);

}  // namespace touchdown::models
