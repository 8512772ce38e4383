#pragma once

#include <vector>

#include <Eigen/Core>

#include "models/robot_model.hpp"
#include "odometry/wheeled_leg.hpp"
#include "recordings/recording.hpp"
#include "scoring/trajectory.hpp"

namespace touchdown::experiments {

/// What odometry needs of a run besides its signals.
struct RunMotion {
  odometry::WheeledBiped robot;                 ///< as its description has it
  std::vector<Eigen::Vector3d> specific_force;  ///< that the accelerometer reports (m/s²)
  scoring::Trajectory truth;                    ///< of the IMU, with the axes of the base
};

/// Errors: `InputError` for a robot whose joints do not turn about ±y, see `wheeled_biped`.
RunMotion motion_of(const recordings::Recording& recording, const models::RobotModel& robot);

/// The robot as odometry knows it, from its model. Errors: `InputError` when a joint does not turn
/// about ±y: legs are taken to be plane.
odometry::WheeledBiped wheeled_biped(const models::RobotModel& robot);

}  // namespace touchdown::experiments
