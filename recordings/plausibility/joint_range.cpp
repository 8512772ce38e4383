#include "recordings/plausibility/joint_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

namespace touchdown::recordings {

namespace {

/// Joints are zeroed by hand, to a few hundredths of a radian, and give at their stops.
constexpr double margin = 0.3;  // rad
/// Upkie's knees, which bend furthest: ±2.51 rad. Legs of other robots count from Upkie's zero,
/// the straight leg, so they stay within the same half turn.
constexpr JointRange half_turn = {-2.51, 2.51};

constexpr double degrees_per_radian = 57.296;

bool is_within(const JointRange& inner, const JointRange& outer, double unit) {
  return inner.lowest >= unit * (outer.lowest - margin) &&
         inner.highest <= unit * (outer.highest + margin);
}

}  // namespace

JointRangeCheck::JointRangeCheck(const CheckedRobot& robot) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  range_.fill(half_turn);
  if (robot.ranges) range_ = *robot.ranges;
  found_.fill({infinity, -infinity});
}

void JointRangeCheck::add(const models::Observation& record) {
  for (std::size_t i = 0; i < found_.size(); ++i) {
    const double position = record.servo[i].position;
    if (position < found_[i].lowest) found_[i].lowest = position;
    if (position > found_[i].highest) found_[i].highest = position;
  }
}

bool JointRangeCheck::report(Findings& findings) const {
  bool are_within = true;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    const bool is_wheel = i % 3 == 2;
    if (is_wheel || found_[i].lowest > found_[i].highest) continue;
    if (is_within(found_[i], range_[i], 1.0)) continue;
    are_within = false;
    const bool fits_degrees = is_within(found_[i], range_[i], degrees_per_radian);
    findings.add(models::servo_names.at(i),
                 fmt::format("position leaves its range of {:.3g} to {:.3g} rad: {}",
                             range_[i].lowest, range_[i].highest,
                             fits_degrees ? "is it in degrees, or are joints in another order"
                                          : "check its zero, its sign and the order of joints"));
  }
  return are_within;
}

}  // namespace touchdown::recordings
