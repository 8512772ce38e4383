#include "logs/plausibility/window.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "estimator/force/servo_law.hpp"

namespace touchdown::logs {

namespace {

constexpr double window_length = 0.1;  // s

/// The step between two positions. A wheel's position may be reported within one turn.
double step_between(double before, double after) {
  const double step = after - before;
  return std::abs(step) > std::numbers::pi ? std::remainder(step, 2.0 * std::numbers::pi) : step;
}

/// Left hip, knee, wheel, then right.
const JointTarget& target_of(const ServoTargets& targets, std::size_t i) {
  const LegTargets& leg = targets[i / 3];
  return i % 3 == 0 ? leg.hip : i % 3 == 1 ? leg.knee : leg.wheel;
}

/// Adds the torques of the servo's law. `other`: the target of the same joint of the other leg.
void add_law(const models::ServoReading& servo, const JointTarget& own, const JointTarget& other,
             CheckedWindow::Joint& joint) {
  const auto law = [&](const JointTarget& target, double factor) {
    JointTarget meant = own;
    meant.position = factor * target.position;
    meant.velocity = factor * target.velocity;
    return servo_torque({servo.position, servo.velocity, servo.torque}, meant);
  };
  constexpr double degree = std::numbers::pi / 180.0;
  const std::array<double, 4> laws = {law(own, 1.0), law(own, -1.0), law(other, 1.0),
                                      law(own, degree)};
  for (std::size_t i = 0; i < laws.size(); ++i) joint.law[i] += laws[i];
  joint.kp += own.kp;
}

/// The rotation vector (rad) from one orientation to the next, in the IMU's frame. NaN for a
/// quaternion that is none.
Eigen::Vector3d rotation_between(const Eigen::Quaterniond& before,
                                 const Eigen::Quaterniond& after) {
  Eigen::Quaterniond turn = before.conjugate() * after;
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  const double sine = turn.vec().norm();
  if (!(sine > 0.0)) return turn.vec();
  return 2.0 * std::atan2(sine, turn.w()) / sine * turn.vec();
}

/// An orientation as it would be if its numbers were read in the other order.
Eigen::Quaterniond in_other_order(const Eigen::Quaterniond& orientation,
                                  const QuaternionReading& reading) {
  const Eigen::Quaterniond axes(reading.axes);
  const auto z_up = Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);  // half a turn about x
  const auto reference = reading.is_z_up ? z_up : Eigen::Quaterniond::Identity();
  const Eigen::Quaterniond q = reference.conjugate() * orientation * axes;
  const Eigen::Quaterniond other = reading.is_w_last
                                       ? Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w())
                                       : Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y());
  return reference * other * axes.conjugate();
}

}  // namespace

WindowCollector::WindowCollector(double period, const QuaternionReading& reading)
    : period_(period),
      reading_(reading),
      length_(std::max<std::size_t>(
          2, static_cast<std::size_t>(std::llround(window_length / period)))) {}

std::optional<CheckedWindow> WindowCollector::add(const models::Observation& record,
                                                  const ServoTargets& targets) {
  if (!std::isfinite(record.time)) return std::nullopt;
  constexpr double longest_step = 5.0;  // periods
  const double step = record.time - previous_.time;
  if (count_ > 0 && !(step >= 0.0 && step <= longest_step * period_ + 0.01)) count_ = 0;
  if (count_ == 0) {
    sum_ = {};
    first_ = record;
  }
  for (std::size_t i = 0; i < record.servo.size(); ++i) {
    const models::ServoReading& servo = record.servo[i];
    sum_.joint[i].position += servo.position;
    sum_.joint[i].velocity += servo.velocity;
    sum_.joint[i].torque += servo.torque;
    add_law(servo, target_of(targets, i), target_of(targets, (i + 3) % 6), sum_.joint[i]);
    if (count_ > 0) {
      const models::ServoReading& before = previous_.servo[i];
      sum_.joint[i].position_change += step_between(before.position, servo.position);
      sum_.joint[i].velocity_change += step_between(before.velocity, servo.velocity);
    }
  }
  sum_.angular_velocity += record.imu.angular_velocity;
  sum_.linear_acceleration += record.imu.linear_acceleration;
  sum_.proper_acceleration += record.imu.raw_linear_acceleration;
  previous_ = record;
  if (++count_ < length_) return std::nullopt;
  const CheckedWindow window = finish(record);
  count_ = 0;
  if (!(window.duration > 0.0)) return std::nullopt;
  return window;
}

CheckedWindow WindowCollector::finish(const models::Observation& record) const {
  CheckedWindow window = sum_;
  const double share = 1.0 / static_cast<double>(count_);
  window.start = first_.time;
  window.duration = record.time - first_.time;
  for (CheckedWindow::Joint& joint : window.joint) {
    for (double* const sum : {&joint.position, &joint.velocity, &joint.torque, &joint.kp}) {
      *sum *= share;
    }
    for (double& law : joint.law) law *= share;
  }
  window.angular_velocity *= share;
  window.linear_acceleration *= share;
  window.proper_acceleration *= share;
  const Eigen::Quaterniond& first = first_.imu.orientation;
  const Eigen::Quaterniond& last = record.imu.orientation;
  window.turn_rate = rotation_between(first, last) / window.duration;
  window.other_turn_rate =
      rotation_between(in_other_order(first, reading_), in_other_order(last, reading_)) /
      window.duration;
  // The reference's z axis points down.
  window.up = last.conjugate() * Eigen::Vector3d(0.0, 0.0, -1.0);
  return window;
}

namespace {

constexpr int windows = 5;  // of a tenth of a second
/// A balancing robot sways by a few hundredths of a rad/s. The error of an attitude filter (0.03
/// rad over seconds, noise/profiles/harsh.yaml) adds up to 0.1 rad/s to a window.
constexpr double fastest_turn = 0.35;  // rad/s
/// A leg that lands or pushes off moves by several rad/s. In degrees, a leg that is held still
/// moves by less than this, too.
constexpr double fastest_leg = 0.2;  // rad/s

bool is_still(const CheckedWindow& window) {
  bool still = window.turn_rate.norm() < fastest_turn;  // written so that NaN fails
  for (std::size_t i = 0; i < window.joint.size(); ++i) {
    const bool is_wheel = i % 3 == 2;
    const double change = std::abs(window.joint[i].position_change);
    still = still && (is_wheel || change < fastest_leg * window.duration);
  }
  return still;
}

void add_to(CheckedWindow& sum, const CheckedWindow& window, double weight) {
  for (std::size_t i = 0; i < sum.joint.size(); ++i) {
    sum.joint[i].position += weight * window.joint[i].position;
    sum.joint[i].velocity += weight * window.joint[i].velocity;
    sum.joint[i].torque += weight * window.joint[i].torque;
  }
  sum.angular_velocity += weight * window.angular_velocity;
  sum.linear_acceleration += weight * window.linear_acceleration;
  sum.proper_acceleration += weight * window.proper_acceleration;
  sum.up += weight * window.up;
}

}  // namespace

std::optional<CheckedWindow> StillStretches::add(const CheckedWindow& window) {
  if (!is_still(window)) {
    count_ = 0;
    return std::nullopt;
  }
  if (count_ == 0) {
    sum_ = {};
    sum_.start = window.start;
  }
  add_to(sum_, window, 1.0 / windows);
  if (++count_ < windows) return std::nullopt;
  count_ = 0;
  sum_.duration = window.start + window.duration - sum_.start;
  return sum_;
}

}  // namespace touchdown::logs
