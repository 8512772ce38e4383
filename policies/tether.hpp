#pragma once

#include <Eigen/Core>

#include "models/robot.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::policies {

/// A rope from a fixed point in the world to the robot's handle: a spring that only pulls, with
/// damping along its length.
struct Tether {
  Eigen::Vector3d anchor = {0.0, 0.0, 2.0};          ///< in the world (m)
  Eigen::Vector3d point_in_base = {0.0, 0.0, 0.06};  ///< where it holds the robot (m)
  double length = 1.0;                               ///< slack below this (m)
  double stiffness = 2000.0;                         ///< N/m
  double damping = 100.0;                            ///< N·s/m
};

/// The force on the robot at `point_in_base`, in the world frame (N); zero when slack.
Eigen::Vector3d tether_force(const Tether& tether, const models::GroundTruth& robot);

void describe(Fields& fields, Tether& tether);

}  // namespace touchdown::policies
