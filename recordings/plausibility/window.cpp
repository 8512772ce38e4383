#include "recordings/plausibility/window.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace touchdown::recordings {

namespace {

constexpr double window_length = 0.1;  // s

/// The step between two positions. A wheel's position may be reported within one turn.
double step_between(double before, double after) {
  const double step = after - before;
  return std::abs(step) > std::numbers::pi ? std::remainder(step, 2.0 * std::numbers::pi) : step;
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

}  // namespace

WindowCollector::WindowCollector(double period)
    : period_(period),
      length_(std::max<std::size_t>(
          2, static_cast<std::size_t>(std::llround(window_length / period)))) {}

std::optional<CheckedWindow> WindowCollector::add(const models::Observation& record) {
  if (!std::isfinite(record.time)) return std::nullopt;
  constexpr double longest_step = 5.0;  // periods
  const double step = record.time - previous_.time;
  if (count_ > 0 && !(step >= 0.0 && step <= longest_step * period_ + 0.01)) count_ = 0;
  if (count_ == 0) begin(record);
  for (std::size_t i = 0; i < change_.size(); ++i) {
    const models::ServoReading& servo = record.servo[i];
    sum_.joint[i].position += servo.position;
    sum_.joint[i].velocity += servo.velocity;
    sum_.joint[i].torque += servo.torque;
    if (count_ > 0) change_[i] += step_between(previous_.servo[i].position, servo.position);
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

void WindowCollector::begin(const models::Observation& record) {
  sum_ = {};
  first_ = previous_ = record;
  change_ = {};
}

CheckedWindow WindowCollector::finish(const models::Observation& record) const {
  CheckedWindow window = sum_;
  const double share = 1.0 / static_cast<double>(count_);
  window.start = first_.time;
  window.duration = record.time - first_.time;
  for (std::size_t i = 0; i < change_.size(); ++i) {
    window.joint[i].position *= share;
    window.joint[i].velocity *= share;
    window.joint[i].torque *= share;
    window.joint[i].position_change = change_[i];
  }
  window.angular_velocity *= share;
  window.linear_acceleration *= share;
  window.proper_acceleration *= share;
  window.turn_rate =
      rotation_between(first_.imu.orientation, record.imu.orientation) / window.duration;
  // The reference's z axis points down.
  window.up = record.imu.orientation.conjugate() * Eigen::Vector3d(0.0, 0.0, -1.0);
  return window;
}

}  // namespace touchdown::recordings
