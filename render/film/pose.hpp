#pragma once

#include <vector>

#include <Eigen/Core>

#include "models/robot_model.hpp"
#include "recordings/recording.hpp"

namespace touchdown::render {

/// The robot's configuration at every row of a recording, as MuJoCo's qpos.
///
/// A simulated run has the base's pose in its ground truth. For a robot's log, the orientation
/// comes from the IMU and the position from the wheels' odometry, and the lower tyre is put on the
/// floor.
class Poses {
 public:
  /// Keeps references to both. Errors: `InputError` for a recording without rows.
  Poses(const models::RobotModel& robot, const recordings::Recording& recording);

  std::size_t count() const { return base_.size(); }
  /// The base's position in the world (m). NaN is replaced by the last number before it.
  const Eigen::Vector3d& base_position(std::size_t row) const { return base_[row]; }
  /// Writes the row's positions into `data` and computes the poses of all geoms.
  void apply(std::size_t row, mjData& data) const;

 private:
  const models::RobotModel& robot_;
  const recordings::Recording& recording_;
  std::vector<Eigen::Vector3d> base_;
};

/// Computes all that MuJoCo's renderer needs from the positions in `data`.
void update_geoms(const mjModel& model, mjData& data);

/// Filters `values`, sampled every `period` seconds, with a first-order low-pass of `time_constant`
/// seconds, forward and then backward. The result is smooth and has no lag.
std::vector<Eigen::Vector3d> smoothed(std::vector<Eigen::Vector3d> values, double period,
                                      double time_constant);

}  // namespace touchdown::render
