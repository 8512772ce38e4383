#pragma once

#include "models/robot.hpp"

namespace touchdown::simulators {

/// The torque that a moteus-like servo applies to its joint (N·m):
///     clamp(feedforward + kd·kd_scale·(ω* − ω) + kp·kp_scale·(q* − q), ± limit),
/// where a NaN target position q* drops the position term and the limit is the smaller of the
/// command's maximum torque and the motor's effort.
double servo_torque(const models::ServoCommand& command, double position, double velocity,
                    double effort);

}  // namespace touchdown::simulators
