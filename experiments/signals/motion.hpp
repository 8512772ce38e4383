#pragma once

#include <vector>

#include <Eigen/Core>

#include "estimator/odometry/wheeled_leg.hpp"
#include "models/robot_model.hpp"
#include "recordings/recording.hpp"
#include "scoring/trajectory.hpp"

namespace touchdown::experiments {

/// The data of a run that odometry needs besides the signals.
struct RunMotion {
  odometry::WheeledBiped robot;                 ///< from the robot's description
  std::vector<Eigen::Vector3d> specific_force;  ///< reported by the accelerometer (m/s²)
  scoring::Trajectory truth;  ///< pose of the IMU's origin, with the axes of the base
};

/// Errors: `InputError` for a robot with joints that do not turn about ±y, see `wheeled_biped`.
RunMotion motion_of(const recordings::Recording& recording, const models::RobotModel& robot);

/// The kinematic model for odometry, from the robot's MuJoCo model. It assumes planar legs. Errors:
/// `InputError` when a joint does not turn about ±y.
odometry::WheeledBiped wheeled_biped(const models::RobotModel& robot);

}  // namespace touchdown::experiments
