#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "estimator/force/leg_geometry.hpp"
#include "models/robot.hpp"
#include "recordings/plausibility/findings.hpp"

namespace touchdown::recordings {

/// The positions that a joint can reach (rad).
struct JointRange {
  double lowest = 0.0;
  double highest = 0.0;
};
using JointRanges = std::array<JointRange, models::servo_count>;

/// What the checks of a log know about its robot. Without legs or ranges, Upkie's are assumed, with
/// wider limits.
struct CheckedRobot {
  std::optional<LegGeometry> legs = {};
  std::optional<JointRanges> ranges = {};  ///< wheels have none, and are not checked
};

/// Checks every value of a record against the largest that a sensor can report (`SignalBounds`).
class SensorRangeCheck {
 public:
  /// Returns the record with NaN in place of every value beyond its bound.
  models::Observation add(const models::Observation& record);
  void report(Findings& findings) const;

 private:
  /// The values of one channel beyond its bound.
  struct Beyond {
    std::int64_t count = 0;
    double first = 0.0;
    double time = 0.0;  ///< of the first (s)
  };
  struct Joint {
    Beyond position;
    Beyond velocity;
    Beyond torque;
  };

  static void check(double& value, double largest, double time, Beyond& beyond);

  std::array<Joint, models::servo_count> joints_ = {};
  Beyond orientation_;
  Beyond angular_velocity_;
  Beyond linear_acceleration_;
  Beyond proper_acceleration_;
};

/// Checks that hips and knees stay within their range.
class JointRangeCheck {
 public:
  explicit JointRangeCheck(const CheckedRobot& robot);

  void add(const models::Observation& record);
  /// Returns whether all joints are within their range.
  bool report(Findings& findings) const;

 private:
  JointRanges range_;
  JointRanges found_;
};

}  // namespace touchdown::recordings
