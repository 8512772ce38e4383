#pragma once

#include <array>

#include "recordings/plausibility/findings.hpp"
#include "recordings/plausibility/robot.hpp"

namespace touchdown::recordings {

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
