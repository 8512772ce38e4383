#pragma once

#include <array>
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
