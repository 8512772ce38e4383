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

/// Errors: `InputError` unless hips and knees can have these angles (rad).
void require_stance(const models::RobotModel& model, double hip, double knee);

/// A stance in the zeros of the robot's file, as angles from straight legs.
models::Stance from_straight(const models::RobotModel& model, const models::Stance& stance);

}  // namespace touchdown::scenarios
