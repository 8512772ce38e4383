#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <Eigen/Core>

#include "estimator/signals.hpp"
#include "logs/log/record_source.hpp"
#include "models/robot.hpp"

namespace touchdown::logs {

/// The commands that the servos executed when a record was measured. NaN: not known.
using ServoTargets = std::array<LegTargets, 2>;

/// Means of consecutive records over a tenth of a second. It is long enough to average noise and
/// resolution, and short enough to follow the motion of a robot. Values are NaN if one of the
/// records lacks them.
struct CheckedWindow {
  double start = 0.0;     ///< time of the first record (s)
  double duration = 0.0;  ///< by the clock (s)
  struct Joint {
    double position = 0.0;         ///< rad
    double velocity = 0.0;         ///< rad/s, as reported
    double torque = 0.0;           ///< N·m
    double position_change = 0.0;  ///< rad, over the window; half turns count the short way
    double velocity_change = 0.0;  ///< rad/s, likewise
    double kp = 0.0;               ///< position gain of the target (N·m/rad)
    /// By the servo's law (N·m): of the target as it is, negated, the other leg's, in degrees.
    std::array<double, 4> law = {};
  };
  std::array<Joint, models::servo_count> joint = {};
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< as reported, IMU frame (rad/s)
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();  ///< by the orientation, IMU frame (rad/s)
  Eigen::Vector3d linear_acceleration = Eigen::Vector3d::Zero();  ///< m/s²
  Eigen::Vector3d proper_acceleration = Eigen::Vector3d::Zero();  ///< m/s²
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  ///< by the orientation, in the IMU frame
  /// As `turn_rate`, if the quaternion's numbers are in the other order (`QuaternionReading`).
  Eigen::Vector3d other_turn_rate = Eigen::Vector3d::Zero();
};

/// Collects records to windows. A gap in time, or a step back, drops the window that it interrupts.
class WindowCollector {
 public:
  /// `period`: between two records (s).
  WindowCollector(double period, const QuaternionReading& reading);

  /// Adds a record. Returns the window that it completes, if any.
  std::optional<CheckedWindow> add(const models::Observation& record, const ServoTargets& targets);

 private:
  CheckedWindow finish(const models::Observation& record) const;

  double period_;
  QuaternionReading reading_;
  std::size_t length_;
  std::size_t count_ = 0;
  CheckedWindow sum_;
  models::Observation first_;
  models::Observation previous_;
};

/// Finds stretches of half a second in which the robot neither turns nor moves its legs: it stands,
/// or hangs. Such a robot accelerates little on average, so that its accelerometer shows gravity
/// alone, and its legs carry its weight, or nothing.
class StillStretches {
 public:
  /// Adds the next window. Returns the means over a stretch that it completes, if any.
  std::optional<CheckedWindow> add(const CheckedWindow& window);

 private:
  CheckedWindow sum_;
  int count_ = 0;
};

}  // namespace touchdown::logs
