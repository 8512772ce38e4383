#pragma once

#include "models/robot_model.hpp"
#include "scenarios/scenario.hpp"
#include "simulators/simulator.hpp"

namespace touchdown::scenarios {

/// The robot at rest at `start`: crouched, its wheels on the ground (or `clearance` above it), and
/// tilted so that its centre of mass is over the axle. If the legs have different lengths, the
/// shorter one has the angles of `start`. The longer one bends more until both wheels share one
/// axle. Errors: `InputError` if it cannot.
simulators::RobotState start_pose(const models::RobotModel& model, const models::Terrain& terrain,
                                  const Start& start);

}  // namespace touchdown::scenarios
