#pragma once

#include <vector>

#include <Eigen/Core>

namespace touchdown {
class Fields;
}

namespace touchdown::policies {

/// A constant force on the robot's base for a while: a push, a lift.
struct TimedForce {
  double time = 0.0;      ///< from here on (s)
  double duration = 0.1;  ///< for so long (s)
  /// In the world frame (N).
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  /// Where it acts, in the base frame (m).
  Eigen::Vector3d point_in_base = Eigen::Vector3d::Zero();
  /// The force turns with the robot's heading: x ahead of it, y to its left.
  bool along_heading = false;

  bool acts_at(double t) const { return t >= time && t < time + duration; }
};

/// The forces of a run; they may overlap.
using ForceScript = std::vector<TimedForce>;

/// The force in the world frame (N) on a robot that heads for `yaw` (rad).
Eigen::Vector3d force_in_world(const TimedForce& force, double yaw);

void describe(Fields& fields, TimedForce& force);

}  // namespace touchdown::policies
