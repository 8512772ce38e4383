#pragma once

#include "models/contract/contract.hpp"
#include "models/robot_description.hpp"
#include "models/robot_model.hpp"

namespace touchdown::models {

/// Finds the held joints and the servos that hold them. A position servo of the file keeps its
/// gains. Others get those that `gains: lqr` gives to hips and knees, of a pendulum of the robot's
/// weight and leg length. MuJoCo simulates their rotors; the simulators add everything else.
/// Errors: `InputError` for a joint that is no hinge, has a spring or shares its body with another
/// joint, and for one without a torque limit.
void find_held(RobotModel& robot, const RobotDescription& description, const Contract& contract);

}  // namespace touchdown::models
