#include "logs/plausibility/channels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "estimator/record.hpp"
#include "estimator/signal_bounds.hpp"

namespace touchdown::logs {

namespace {

constexpr std::int64_t least_records = 300;  // a third of a second at 1 kHz

Eigen::Vector3d up_of(const Eigen::Quaterniond& q) {
  return up_in_imu({q.w(), q.x(), q.y(), q.z()});
}

/// Estimators do not use such an orientation.
bool has_other_length(const Eigen::Quaterniond& q) {
  return q.coeffs().allFinite() && !up_of(q).allFinite();
}

std::string throughout(std::string_view channel, double value) {
  // 0 is added to show −0 as 0.
  return fmt::format("{} is {:.6g} throughout: is the sensor dead, or the column empty", channel,
                     value + 0.0);
}

}  // namespace

void ConstantChannels::Channel::add(double value) {
  if (!std::isfinite(value)) {
    ++missing;
    return;
  }
  if (count == 0) first = value;
  ++count;
  sum_of_sizes += std::abs(value);
  changes = changes || value != first;
}

bool ConstantChannels::Channel::is_constant() const { return count >= least_records && !changes; }

void ConstantChannels::add(const models::Observation& record) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    joints_[i][0].add(record.servo[i].position);
    joints_[i][1].add(record.servo[i].velocity);
    joints_[i][2].add(record.servo[i].torque);
  }
  const models::ImuReading& imu = record.imu;
  const Eigen::Quaterniond& q = imu.orientation;
  const bool is_usable = !has_other_length(q);
  const std::array<double, 4> orientation = {q.w(), q.x(), q.y(), q.z()};
  for (std::size_t i = 0; i < 4; ++i) {
    orientation_[i].add(is_usable ? orientation[i] : std::nan(""));
  }
  // Gravity that was removed by the orientation hides a dead accelerometer.
  const bool is_removed = imu.raw_linear_acceleration.isZero(0.0);
  const Eigen::Vector3d with_gravity = imu.linear_acceleration + gravity_at_rest * up_of(q);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    angular_velocity_[i].add(imu.angular_velocity[axis]);
    if (is_usable) linear_acceleration_[i].add(imu.linear_acceleration[axis]);
    constexpr double digits = 1e5;  // of a log that holds floats
    const double proper = is_removed ? std::round(digits * with_gravity[axis]) / digits
                                     : imu.raw_linear_acceleration[axis];
    if (std::isfinite(proper)) proper_acceleration_[i].add(proper);
  }
}

/// Bad sensors drop out for a thousandth of the time (noise/profiles/harsh.yaml).
void ConstantChannels::report_missing(std::string_view subject, const char* channel,
                                      const Channel& of_log, Findings& findings,
                                      const char* expected) {
  constexpr double most = 0.02;
  const double share =
      static_cast<double>(of_log.missing) / static_cast<double>(of_log.count + of_log.missing);
  if (!(share > most)) return;
  findings.add(subject, share == 1.0 ? fmt::format("{}is never {}", channel, expected)
                                     : fmt::format("{}is missing in {:.0f} % of the records",
                                                   channel, 100.0 * share));
}

bool ConstantChannels::lacks_hips() const {
  constexpr std::size_t right = 3;
  return std::ranges::all_of(joints_[0], &Channel::is_zero) &&
         std::ranges::all_of(joints_[right], &Channel::is_zero);
}

void ConstantChannels::report_joint(std::size_t servo, Findings& findings) const {
  const auto& [position, velocity, torque] = joints_[servo];
  const std::string_view name = models::servo_names.at(servo);
  report_missing(name, "position ", position, findings);
  report_missing(name, "velocity ", velocity, findings);
  report_missing(name, "torque ", torque, findings);
  if (servo % 3 == 0 && lacks_hips()) return;
  if (torque.is_constant()) findings.add(name, throughout("torque", torque.first));
  constexpr double moved = 0.1;  // rad/s, mean of its size
  const bool reports_motion = velocity.sum_of_sizes > moved * static_cast<double>(velocity.count);
  if (position.is_constant() && reports_motion) {
    findings.add(name, throughout("position", position.first));
  }
  if (velocity.is_constant() && !position.is_constant()) {
    findings.add(name, throughout("velocity", velocity.first));
  }
}

/// Returns whether all axes change.
bool ConstantChannels::report_vector(const char* name, const std::array<Channel, 3>& axes,
                                     Findings& findings) {
  report_missing(name, "", axes[0], findings);
  const auto constant = std::ranges::count_if(axes, &Channel::is_constant);
  if (constant == 3) {
    findings.add(name, fmt::format("is {:.6g} {:.6g} {:.6g} throughout: is the sensor dead, or the "
                                   "column empty",
                                   axes[0].first + 0.0, axes[1].first + 0.0, axes[2].first + 0.0));
    return false;
  }
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].is_constant()) {
      findings.add(fmt::format("{} {}", name, "xyz"[i]), throughout("it", axes[i].first));
    }
  }
  return constant == 0;
}

bool ConstantChannels::report(Findings& findings) const {
  for (std::size_t servo = 0; servo < joints_.size(); ++servo) report_joint(servo, findings);
  report_vector("angular_velocity", angular_velocity_, findings);
  report_missing("orientation", "", orientation_[0], findings,
                 "a quaternion of length 1: is the column empty, or to be divided by its length");
  if (std::ranges::all_of(orientation_, &Channel::is_constant)) {
    findings.add("orientation", "never changes: is the sensor dead, or the column empty");
  }
  return !report_vector("linear_acceleration", linear_acceleration_, findings) ||
         report_vector("proper_acceleration", proper_acceleration_, findings);
}

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

/// The largest size of a channel of `SensorRangeCheck`.
struct Bound {
  std::string_view subject;
  const char* channel;
  const char* unit;
  double largest;
};

constexpr std::size_t of_joints = 3 * models::servo_count;

Bound bound_of(std::size_t channel) {
  constexpr std::array<Bound, 3> of_joint = {{{"", "position ", " rad", bounds.leg_position},
                                              {"", "velocity ", " rad/s", bounds.velocity},
                                              {"", "torque ", " N·m", bounds.torque}}};
  constexpr std::array<Bound, 4> of_imu = {
      {{"orientation", "", "", largest_of_quaternion},
       {"angular_velocity", "", " rad/s", bounds.angular_velocity},
       {"linear_acceleration", "", " m/s²", bounds.acceleration},
       {"proper_acceleration", "", " m/s²", bounds.acceleration}}};
  if (channel >= of_joints) return of_imu.at(channel - of_joints);
  Bound bound = of_joint.at(channel % 3);
  bound.subject = models::servo_names.at(channel / 3);
  constexpr std::size_t wheel_position = 6;  // of a leg's nine
  if (channel % 9 == wheel_position) bound.largest = bounds.wheel_position;
  return bound;
}

}  // namespace

models::Observation SensorRangeCheck::add(const models::Observation& record) {
  models::Observation usable = record;
  std::size_t channel = 0;
  const auto check = [&](double& value) {
    if (!std::isfinite(value) || std::abs(value) <= bound_of(channel).largest) return;
    Beyond& beyond = channels_.at(channel);
    if (beyond.count++ == 0) {
      beyond.first = value;
      beyond.time = record.time;
    }
    value = std::numeric_limits<double>::quiet_NaN();
  };
  for (models::ServoReading& servo : usable.servo) {
    for (double* const value : {&servo.position, &servo.velocity, &servo.torque}) {
      check(*value);
      ++channel;
    }
  }
  models::ImuReading& imu = usable.imu;
  for (double& part : imu.orientation.coeffs()) check(part);
  for (Eigen::Vector3d* const vector :
       {&imu.angular_velocity, &imu.linear_acceleration, &imu.raw_linear_acceleration}) {
    ++channel;
    for (double& axis : *vector) check(axis);
  }
  if (has_other_length(imu.orientation)) {
    imu.orientation.coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return usable;
}

void SensorRangeCheck::report(Findings& findings) const {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Beyond& beyond = channels_.at(i);
    if (beyond.count == 0) continue;
    const Bound bound = bound_of(i);
    findings.add(
        bound.subject,
        fmt::format("{}is {}{} at {} s{}, beyond any sensor's {:.0f}{}: is it a "
                    "fault of the bus, or of the conversion",
                    bound.channel, readable(beyond.first, 3), bound.unit, readable(beyond.time, 6),
                    beyond.count == 1 ? "" : fmt::format(" (first of {})", beyond.count),
                    bound.largest, bound.unit));
  }
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

}  // namespace touchdown::logs
