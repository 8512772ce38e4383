#include "recordings/plausibility/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "estimator/signal_bounds.hpp"

namespace touchdown::recordings {

namespace {

/// Joints are zeroed by hand, to a few hundredths of a radian, and give at their stops.
constexpr double margin = 0.3;  // rad
/// Upkie's knees, which bend furthest: ±2.51 rad. Legs of other robots count from Upkie's zero,
/// the straight leg, so they stay within the same half turn.
constexpr JointRange half_turn = {-2.51, 2.51};

constexpr double degrees_per_radian = 57.296;

constexpr SignalBounds bounds;
constexpr double largest_of_quaternion = 1e3;  // of each part; some drivers do not normalise

bool is_within(const JointRange& inner, const JointRange& outer, double unit) {
  return inner.lowest >= unit * (outer.lowest - margin) &&
         inner.highest <= unit * (outer.highest + margin);
}

}  // namespace

models::Observation SensorRangeCheck::add(const models::Observation& record) {
  models::Observation usable = record;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    models::ServoReading& servo = usable.servo[i];
    const bool is_wheel = i % 3 == 2;
    check(servo.position, is_wheel ? bounds.wheel_position : bounds.leg_position, record.time,
          joints_[i].position);
    check(servo.velocity, bounds.velocity, record.time, joints_[i].velocity);
    check(servo.torque, bounds.torque, record.time, joints_[i].torque);
  }
  models::ImuReading& imu = usable.imu;
  for (double& part : imu.orientation.coeffs()) {
    check(part, largest_of_quaternion, record.time, orientation_);
  }
  for (double& axis : imu.angular_velocity) {
    check(axis, bounds.angular_velocity, record.time, angular_velocity_);
  }
  for (double& axis : imu.linear_acceleration) {
    check(axis, bounds.acceleration, record.time, linear_acceleration_);
  }
  for (double& axis : imu.raw_linear_acceleration) {
    check(axis, bounds.acceleration, record.time, proper_acceleration_);
  }
  return usable;
}

void SensorRangeCheck::check(double& value, double largest, double time, Beyond& beyond) {
  if (!std::isfinite(value) || std::abs(value) <= largest) return;
  if (beyond.count++ == 0) {
    beyond.first = value;
    beyond.time = time;
  }
  value = std::numeric_limits<double>::quiet_NaN();
}

void SensorRangeCheck::report(Findings& findings) const {
  const auto add = [&](std::string_view subject, const char* channel, const char* unit,
                       double largest, const Beyond& beyond) {
    if (beyond.count == 0) return;
    findings.add(subject,
                 fmt::format("{}is {:.3g}{} at {:.6g} s{}, beyond any sensor's {:.0f}{}: is it a "
                             "fault of the bus, or of the conversion",
                             channel, beyond.first, unit, beyond.time,
                             beyond.count == 1 ? "" : fmt::format(" (first of {})", beyond.count),
                             largest, unit));
  };
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const std::string_view name = models::servo_names.at(i);
    const bool is_wheel = i % 3 == 2;
    add(name, "position ", " rad", is_wheel ? bounds.wheel_position : bounds.leg_position,
        joints_[i].position);
    add(name, "velocity ", " rad/s", bounds.velocity, joints_[i].velocity);
    add(name, "torque ", " N·m", bounds.torque, joints_[i].torque);
  }
  add("orientation", "", "", largest_of_quaternion, orientation_);
  add("angular_velocity", "", " rad/s", bounds.angular_velocity, angular_velocity_);
  add("linear_acceleration", "", " m/s²", bounds.acceleration, linear_acceleration_);
  add("proper_acceleration", "", " m/s²", bounds.acceleration, proper_acceleration_);
}

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
