#pragma once

#include <Eigen/Core>

#include "recordings/plausibility/findings.hpp"
#include "recordings/plausibility/window.hpp"

namespace touchdown::recordings {

/// Checks the gyroscope against the orientation of a robot that turns: both have the same angular
/// velocity in the IMU's frame. Units, signs, axes and the order of the quaternion show.
class TurningCheck {
 public:
  void add(const CheckedWindow& window);
  void report(Findings& findings) const;

 private:
  int windows_ = 0;
  Eigen::Matrix3d products_ = Eigen::Matrix3d::Zero();  ///< Σ gyroscope · orientation's rateᵀ
  double gyroscope_squares_ = 0.0;
  double orientation_squares_ = 0.0;
};

}  // namespace touchdown::recordings
