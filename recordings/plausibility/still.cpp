#include "recordings/plausibility/still.hpp"

#include <cmath>

namespace touchdown::recordings {

namespace {

constexpr int windows = 5;  // of a tenth of a second
/// A balancing robot sways by a few hundredths of a rad/s. The error of an attitude filter (0.03
/// rad over seconds, sensors/harsh.yaml) adds up to 0.1 rad/s to a window.
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

}  // namespace touchdown::recordings
