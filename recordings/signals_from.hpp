#pragma once

#include <array>

#include "estimator/assembly/record.hpp"
#include "models/robot.hpp"

namespace touchdown::recordings {

/// Radius of Upkie's wheels (m), for converting wheel velocities to ground velocities.
inline constexpr double upkie_wheel_radius = 0.05;

/// Ground velocity that an action commands (m/s), positive forward: the mean of the velocity
/// targets of the left and the reversed right wheel.
double ground_velocity_command(const models::Action& action,
                               double wheel_radius = upkie_wheel_radius);

/// Storage for the joints of a record.
using RecordedJoints = std::array<JointSignals, models::servo_count>;

/// Converts one step to a record of a robot's software. `joints` must outlive the record.
RobotRecord record_of(const models::Observation& observation,
                      double previous_ground_velocity_command, RecordedJoints& joints);

/// The input of a contact estimator at one step. The command is that of the previous step, since
/// this step's action depends on this observation. If the norm of the IMU's quaternion differs from
/// 1 by more than a percent, the vertical acceleration is NaN.
Signals signals_from(const models::Observation& observation,
                     double previous_ground_velocity_command);

}  // namespace touchdown::recordings
