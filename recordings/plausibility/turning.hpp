#pragma once

#include <Eigen/Core>

#include "recordings/plausibility/findings.hpp"
#include "recordings/plausibility/window.hpp"

namespace touchdown::recordings {

/// The angular velocity of a gyroscope and that of the orientation, compared in windows in which
/// the robot turns.
struct TurningComparison {
  int windows = 0;
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();  ///< Σ gyroscope · orientation's rateᵀ
  double gyroscope_squares = 0.0;
  double orientation_squares = 0.0;

  void add(const Eigen::Vector3d& gyroscope, const Eigen::Vector3d& orientation, double least);
};

/// Checks the gyroscope against the orientation of a robot that turns: both have the same angular
/// velocity in the IMU's frame. Units, signs, axes and the order of the quaternion show.
class TurningCheck {
 public:
  void add(const CheckedWindow& window);
  void report(Findings& findings) const;

 private:
  TurningComparison fast_;  ///< of windows
  TurningComparison slow_;  ///< of half seconds
  int count_ = 0;           ///< windows of the present half second
  Eigen::Vector3d gyroscope_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d orientation_ = Eigen::Vector3d::Zero();
};

}  // namespace touchdown::recordings
