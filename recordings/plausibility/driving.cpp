#include "recordings/plausibility/driving.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace touchdown::recordings {

namespace {

constexpr std::size_t left_wheel = 2;
constexpr std::size_t right_wheel = 5;

/// Slower wheels and faster turns do not show whether the wheels roll the same way.
constexpr double least_wheel_speed = 1.0;      // rad/s
constexpr double fastest_straight_turn = 0.3;  // rad/s
constexpr int least_straight = 10;             // windows
/// Robots that drive straight have less than 0.03, and those of which one leg counts the other way
/// more than 30.
constexpr double apart = 6.0;

constexpr int least_accelerations = 30;
/// A robot that is lifted or hangs has up to 0.6 of either sign; one that drives 0.75 to 0.99.
constexpr double drive_follows = 0.75;
/// A robot that swings below its hook follows its wheels, too, but by 0.016 m instead of
/// 0.028 to 0.045 m, nearly the radius of Upkie's wheels.
constexpr double least_radius = 0.025;            // m
constexpr double least_wheel_acceleration = 0.4;  // rad/s², root mean square

/// Speed of the wheels forwards (rad/s): the right one counts the other way.
double forward_speed(const CheckedWindow& window) {
  return 0.5 * (window.joint[left_wheel].velocity - window.joint[right_wheel].velocity);
}

}  // namespace

void DrivingCheck::add(const CheckedWindow& window) {
  const double left = window.joint[left_wheel].velocity;
  const double right = window.joint[right_wheel].velocity;
  const double turn = window.angular_velocity.dot(window.up);
  if (std::abs(turn) < fastest_straight_turn &&
      std::max(std::abs(left), std::abs(right)) > least_wheel_speed) {
    ++straight_;
    same_ += (left - right) * (left - right);
    opposed_ += (left + right) * (left + right);
  }
  const bool is_whole = std::isfinite(left + right) && window.linear_acceleration.allFinite();
  const bool continues =
      count_ > 0 && std::abs(window.start - last_.at(count_ - 1).start -
                             last_.at(count_ - 1).duration) < 0.5 * window.duration;
  if (!is_whole) {
    count_ = 0;
    return;
  }
  if (!continues) count_ = 0;
  if (count_ == length) {
    std::rotate(last_.begin(), last_.begin() + 1, last_.end());
    --count_;
  }
  last_.at(count_++) = window;
  if (count_ == length) add_acceleration();
}

void DrivingCheck::add_acceleration() {
  const double duration = last_.back().start - last_.front().start;
  const double wheels = (forward_speed(last_.back()) - forward_speed(last_.front())) / duration;
  // The change of a mean over windows is the mean acceleration with half weights at both ends.
  Eigen::Vector3d imu =
      0.5 * (last_.front().linear_acceleration + last_.back().linear_acceleration);
  for (std::size_t i = 1; i + 1 < length; ++i) imu += last_.at(i).linear_acceleration;
  imu /= static_cast<double>(length - 1);
  ++accelerations_;
  wheel_sum_ += wheels;
  wheel_squares_ += wheels * wheels;
  imu_sum_ += imu;
  imu_squares_ += imu.cwiseAbs2();
  products_ += wheels * imu;
}

DrivingCheck::Fit DrivingCheck::fit(int axis) const {
  if (accelerations_ < least_accelerations) return {};
  const double n = accelerations_;
  const double wheels = wheel_squares_ - wheel_sum_ * wheel_sum_ / n;
  const double imu = imu_squares_[axis] - imu_sum_[axis] * imu_sum_[axis] / n;
  const double both = products_[axis] - wheel_sum_ * imu_sum_[axis] / n;
  if (!(wheels > least_wheel_acceleration * least_wheel_acceleration * n) || !(imu > 0.0)) {
    return {};
  }
  return {both / std::sqrt(wheels * imu), both / wheels};
}

bool DrivingCheck::turns_apart() const {
  return straight_ >= least_straight && opposed_ > apart * same_;
}

bool DrivingCheck::drives() const {
  const Fit backwards = fit(0);
  return !turns_apart() && std::abs(backwards.correlation) > drive_follows &&
         std::abs(backwards.radius) > least_radius;
}

void DrivingCheck::report(Findings& findings, bool has_acceleration) const {
  if (turns_apart()) {
    findings.add("wheels",
                 "turn in opposite directions although the robot does not turn: on Upkie the right "
                 "leg is the mirror image; if both legs count the same way, map the right one with "
                 "sign -1");
    return;
  }
  if (!has_acceleration) return;
  const Fit backwards = fit(0);  // the IMU's x axis points back
  if (drives() && backwards.correlation > 0.0) {
    findings.add("wheels",
                 "drive backwards while the IMU accelerates forwards: are left and right swapped, "
                 "do all joints count the other way, or does the IMU's x axis point forwards");
  }
  const Fit sideways = fit(1);
  constexpr double unrelated = 0.4;
  constexpr double clearly = 0.85;
  if (std::abs(backwards.correlation) < unrelated && std::abs(sideways.correlation) > clearly &&
      std::abs(sideways.radius) > least_radius) {
    findings.add("linear_acceleration",
                 "its y axis follows the wheels, its x axis does not: check the IMU's axes");
  }
}

}  // namespace touchdown::recordings
