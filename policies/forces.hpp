#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "models/robot.hpp"

namespace touchdown {
class Fields;
class KeyNotes;
}  // namespace touchdown

namespace touchdown::policies {

/// A force on the robot's base for a limited time, such as a push or a lift. It is constant unless
/// it grows and fades.
struct TimedForce {
  double time = 0.0;      ///< start (s)
  double duration = 0.1;  ///< rise and fall included (s)
  double rise = 0.0;      ///< time in which it grows linearly from zero (s)
  double fall = 0.0;      ///< time in which it fades linearly to zero (s)
  /// In the world frame (N).
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  /// Point of action in the base frame (m).
  Eigen::Vector3d point_in_base = Eigen::Vector3d::Zero();
  /// Whether the force turns with the robot's heading: x ahead, y to the left.
  bool along_heading = false;

  bool acts_at(double t) const { return t >= time && t < time + duration; }
  /// The share of the force that acts at time `t`: 1 between rise and fall.
  double share_at(double t) const;
};

/// The forces of a run; they may overlap.
using ForceScript = std::vector<TimedForce>;

/// The force in the world frame (N) at time `t` (s) on a robot with heading `yaw` (rad).
Eigen::Vector3d force_in_world(const TimedForce& force, double t, double yaw);

/// A rope from a fixed point in the world to the robot's handle: a spring with damping along its
/// length that only pulls.
struct Tether {
  Eigen::Vector3d anchor = {0.0, 0.0, 2.0};          ///< in the world (m)
  Eigen::Vector3d point_in_base = {0.0, 0.0, 0.06};  ///< attachment point (m)
  double length = 1.0;                               ///< slack below this (m)
  double stiffness = 2000.0;                         ///< N/m
  double damping = 100.0;                            ///< N·s/m
};

/// The force on the robot at `point_in_base`, in the world frame (N); zero when slack.
Eigen::Vector3d tether_force(const Tether& tether, const models::GroundTruth& robot);

/// A horizontal spring and damper at the robot's handle. It keeps the robot above one place without
/// carrying weight.
struct Guide {
  double x = 0.0;                                    ///< in the world (m)
  double y = 0.0;                                    ///< in the world (m)
  Eigen::Vector3d point_in_base = {0.0, 0.0, 0.06};  ///< attachment point (m)
  double stiffness = 100.0;                          ///< N/m
  double damping = 20.0;                             ///< N·s/m
};

/// The force on the robot at `point_in_base`, in the world frame (N). It is horizontal.
Eigen::Vector3d guide_force(const Guide& guide, const models::GroundTruth& robot);

void describe(Fields& fields, TimedForce& force);
void describe(Fields& fields, Tether& tether);
void describe(Fields& fields, Guide& guide);

/// A point or force as a list of three numbers.
KeyNotes describe_vector(Fields& fields, std::string_view key, Eigen::Vector3d& value);

}  // namespace touchdown::policies
