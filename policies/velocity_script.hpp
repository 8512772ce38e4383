#pragma once

#include <vector>

namespace touchdown {
class Fields;
}

namespace touchdown::policies {

/// From `time` on, drive at these velocities.
struct VelocityCommand {
  double time = 0.0;      ///< s
  double velocity = 0.0;  ///< along the ground, forward positive (m/s)
  double yaw_rate = 0.0;  ///< to the left positive (rad/s)
};

/// What a driver would do with the sticks: piecewise constant commands, sorted by time. Before the
/// first one the robot stands.
using VelocityScript = std::vector<VelocityCommand>;

/// The command in force at `time`.
VelocityCommand command_at(const VelocityScript& script, double time);

/// One command of a script; while it is read, the last one so far, which must be the latest.
void describe(Fields& fields, VelocityCommand& command, const VelocityScript& script);

}  // namespace touchdown::policies
