#pragma once

#include "models/robot_model.hpp"
#include "scenarios/scenario.hpp"
#include "simulators/simulator.hpp"

namespace touchdown::scenarios {

/// The robot at rest at `start`: crouched, its wheels on the ground (or `clearance` above it), and
/// tilted so that its centre of mass stands over the axle. Of legs that are not equally long the
/// shorter one has the angles of `start`, and the longer one bends more, hip and knee, until both
/// wheels are on one axle.
simulators::RobotState start_pose(const models::RobotModel& model, const models::Terrain& terrain,
                                  const Start& start);

}  // namespace touchdown::scenarios
