#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include "recordings/plausibility/findings.hpp"
#include "recordings/plausibility/window.hpp"

namespace touchdown::recordings {

/// Checks a robot that drives: both wheels roll the same way unless it turns, and it accelerates as
/// its wheels do. The right leg is the mirror image of the left one, which no torque shows: the
/// wheels show it.
class DrivingCheck {
 public:
  void add(const CheckedWindow& window);
  /// `has_acceleration`: the linear acceleration is free of gravity.
  void report(Findings& findings, bool has_acceleration) const;
  /// Whether the wheels drive the robot: they are on the ground.
  bool drives() const;

 private:
  /// Half a second between the first and the last one.
  static constexpr std::size_t length = 6;

  /// How well the acceleration along an axis of the IMU follows that of the wheels.
  struct Fit {
    double correlation = 0.0;
    double radius = 0.0;  ///< acceleration by that of the wheels (m)
  };

  bool turns_apart() const;
  Fit fit(int axis) const;
  void add_acceleration();

  int straight_ = 0;      ///< windows in which the wheels roll and the robot does not turn
  double same_ = 0.0;     ///< Σ of the wheels' common speed squared
  double opposed_ = 0.0;  ///< Σ of their difference squared
  std::array<CheckedWindow, length> last_;
  std::size_t count_ = 0;
  int accelerations_ = 0;
  double wheel_sum_ = 0.0;
  double wheel_squares_ = 0.0;
  Eigen::Vector3d imu_sum_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d imu_squares_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d products_ = Eigen::Vector3d::Zero();
};

}  // namespace touchdown::recordings
