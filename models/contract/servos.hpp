#pragma once

#include "models/contract/contract.hpp"
#include "models/robot_model.hpp"

namespace touchdown::models {

/// Finds the floating base, the servos' joints and the torque limits of their motors
/// (models/contract/motor.hpp), and checks them. The laws of position and velocity servos are
/// removed. Errors: `InputError` for anything that would act besides the servos: other joints,
/// springs, several motors on a joint, activations; and for limits that are not symmetric.
void find_servos(RobotModel& robot, const Contract& contract);

}  // namespace touchdown::models
