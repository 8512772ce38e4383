#pragma once

#include "models/robot_model.hpp"
#include "models/terrain.hpp"
#include "simulators/physics.hpp"

namespace touchdown {

struct Start;

/// The robot at rest at `start`: crouched, its wheels on the ground (or `clearance` above it), and
/// tilted so that its centre of mass stands over the axle.
RobotState start_pose(const RobotModel& model, const Terrain& terrain, const Start& start);

}  // namespace touchdown
