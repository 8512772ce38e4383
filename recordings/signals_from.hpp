#pragma once

#include <array>

#include "estimator/assembly/record.hpp"
#include "models/robot.hpp"

namespace touchdown::recordings {

/// Radius of Upkie's wheels (m), which turns wheel velocities into ground velocities.
inline constexpr double upkie_wheel_radius = 0.05;

/// Ground velocity that an action asks the wheels for (m/s), positive forward: the mean of the left
/// wheel's and the reversed right wheel's velocity target.
double ground_velocity_command(const models::Action& action,
                               double wheel_radius = upkie_wheel_radius);

/// Where the joints of a record are kept.
using RecordedJoints = std::array<JointSignals, models::servo_count>;

/// What was recorded at one step, as a robot's software would have it. `joints` must outlive it.
RobotRecord record_of(const models::Observation& observation,
                      double previous_ground_velocity_command, RecordedJoints& joints);

/// What a contact estimator hears at one step. The command is the one of the previous step, since
/// this step's action answers this observation. An IMU whose quaternion is not of unit length (to a
/// percent) knows no vertical: the vertical acceleration is NaN then.
Signals signals_from(const models::Observation& observation,
                     double previous_ground_velocity_command);

}  // namespace touchdown::recordings
