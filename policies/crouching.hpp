#pragma once

#include <vector>

namespace touchdown {
class Fields;
}

namespace touchdown::policies {

/// From `time` on, bends the legs until the hip is at this angle.
struct CrouchCommand {
  double time = 0.0;  ///< s
  double hip = 0.0;   ///< forward positive (rad); 0: straight legs
  double rate = 0.3;  ///< of the hip angle (rad/s)
};

/// Crouch commands, sorted by time. Before the first one the legs keep their initial posture.
using CrouchScript = std::vector<CrouchCommand>;

/// Bound of joint angles in files (rad). Robots have their own ranges.
inline constexpr double largest_angle = 6.2832;

/// Ratio of knee to hip angle. A ratio of 2 would keep the axle of legs with equal links below the
/// hip. But bent knees move mass forward: at a hip of .455 rad the torso would have to lean back by
/// .066 rad. This is the ratio of `start`'s knee .791 and hip .455, where the centre of mass is
/// above the axle with the torso upright. From there to straight legs the lean is within .025 rad.
inline constexpr double knee_per_hip = 0.791 / 0.455;

/// The command at `time`; null before the first one.
const CrouchCommand* crouch_at(const CrouchScript& script, double time);

/// Describes one command of `script`. When reading, it is the last so far, and must be the latest.
void describe(Fields& fields, CrouchCommand& command, const CrouchScript& script);

}  // namespace touchdown::policies
