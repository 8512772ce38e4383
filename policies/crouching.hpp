#pragma once

#include <vector>

namespace touchdown {
class Fields;
}

namespace touchdown::policies {

/// From `time` on, bend the legs until the hip is at this angle.
struct CrouchCommand {
  double time = 0.0;  ///< s
  double hip = 0.0;   ///< forward positive (rad): 0 stands straight
  double rate = 0.3;  ///< at which the hip gets there (rad/s)
};

/// Heights that the robot takes while it drives, sorted by time. Before the first one its legs stay
/// as they were.
using CrouchScript = std::vector<CrouchCommand>;

/// How far a knee bends with its hip. Twice as far would keep the axle of legs with equal links
/// below the hip, but bent knees carry mass forward: at a hip of .455 rad the torso would have to
/// lean back by .066 rad to balance. This is the ratio of `start`'s hip .455 and knee .791, where
/// the centre of mass is above the axle with the torso upright; from there to straight legs the
/// lean stays within .025 rad.
inline constexpr double knee_per_hip = 0.791 / 0.455;

/// The command in force at `time`, null before the first.
const CrouchCommand* crouch_at(const CrouchScript& script, double time);

/// One command of a script; while it is read, the last one so far, which must be the latest.
void describe(Fields& fields, CrouchCommand& command, const CrouchScript& script);

}  // namespace touchdown::policies
