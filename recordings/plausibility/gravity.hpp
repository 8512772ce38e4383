#pragma once

#include "recordings/plausibility/findings.hpp"
#include "recordings/plausibility/window.hpp"

namespace touchdown::recordings {

/// Checks the accelerometer while the robot is still: the linear acceleration is near 0, the proper
/// one is 9.8 m/s² along the upward vertical of the orientation.
class GravityCheck {
 public:
  /// Adds a stretch in which the robot is still (`StillStretches`).
  void add_still(const CheckedWindow& stretch);
  void report(Findings& findings) const;

 private:
  void report_linear(Findings& findings) const;
  void report_proper(Findings& findings) const;

  int stretches_ = 0;
  Eigen::Vector3d linear_ = Eigen::Vector3d::Zero();  ///< sum, along the axes of the IMU
  Eigen::Vector3d up_ = Eigen::Vector3d::Zero();      ///< sum
  int proper_stretches_ = 0;
  Eigen::Vector3d proper_ = Eigen::Vector3d::Zero();     ///< sum
  Eigen::Vector3d proper_up_ = Eigen::Vector3d::Zero();  ///< sum, of the same stretches
};

}  // namespace touchdown::recordings
