#pragma once

#include <vector>

#include <Eigen/Core>

#include "models/robot_model.hpp"
#include "recordings/recording.hpp"

namespace touchdown::render {

/// Where everything was at one row of a recording: MuJoCo's qpos.
///
/// A simulated run has the base's pose in its ground truth. A robot's log does not: there the
/// orientation comes from the IMU, the position from the wheels' odometry, and the lower tyre is
/// put on the floor.
class Poses {
 public:
  /// Keeps references to both. Errors: `InputError` for a recording without rows.
  Poses(const models::RobotModel& robot, const recordings::Recording& recording);

  std::size_t count() const { return base_.size(); }
  /// Of the base, in the world (m). Where the recording has NaN: the last number before.
  const Eigen::Vector3d& base_position(std::size_t row) const { return base_[row]; }
  /// Writes the row's positions into `data` and computes where every geom is.
  void apply(std::size_t row, mjData& data) const;

 private:
  const models::RobotModel& robot_;
  const recordings::Recording& recording_;
  std::vector<Eigen::Vector3d> base_;
};

/// `values`, sampled every `period` seconds, through a first-order low-pass of `time_constant`
/// seconds run forward and then backward: smooth, and with no lag.
std::vector<Eigen::Vector3d> smoothed(std::vector<Eigen::Vector3d> values, double period,
                                      double time_constant);

}  // namespace touchdown::render
