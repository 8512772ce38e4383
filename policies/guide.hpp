#pragma once

#include <Eigen/Core>

#include "models/robot.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::policies {

/// A hand at the robot's handle that keeps it above one place without carrying anything: a level
/// spring and damper.
struct Guide {
  double x = 0.0;                                    ///< in the world (m)
  double y = 0.0;                                    ///< in the world (m)
  Eigen::Vector3d point_in_base = {0.0, 0.0, 0.06};  ///< where it holds the robot (m)
  double stiffness = 100.0;                          ///< N/m
  double damping = 20.0;                             ///< N·s/m
};

/// The force on the robot at `point_in_base`, in the world frame (N): level.
Eigen::Vector3d guide_force(const Guide& guide, const models::GroundTruth& robot);

void describe(Fields& fields, Guide& guide);

}  // namespace touchdown::policies
