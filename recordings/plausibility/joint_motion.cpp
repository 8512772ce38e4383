#include "recordings/plausibility/joint_motion.hpp"

#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace touchdown::recordings {

namespace {

/// Slower joints show resolution, bias and delay of their sensors rather than their motion.
constexpr double least_speed = 0.3;  // rad/s, root mean square of windows
constexpr int least_windows = 10;    // a second
/// Delays and low-passes of tens of milliseconds lower both.
constexpr double follows = 0.7;    // correlation
constexpr double unrelated = 0.4;  // correlation
/// A velocity behind a low-pass is smaller than the derivative.
constexpr double largest_factor = 1.6;

struct KnownFactor {
  double size;  ///< velocity / derivative
  const char* cause;
};

/// Units that are mistaken for each other.
std::string cause_of(double factor) {
  constexpr std::array<KnownFactor, 8> known = {
      {{57.296, "is the velocity in deg/s"},
       {1.0 / 57.296, "is the position in deg, or was a velocity in rad/s mapped as deg/s"},
       {9.5493, "is the velocity in rpm"},
       {1.0 / 9.5493, "was a velocity in rad/s mapped as rpm"},
       {1.0 / 6.2832, "is the velocity in rev/s"},
       {6.2832, "is the position in rev, or was a velocity in rad/s mapped as rev/s"},
       {1000.0, "is the velocity in mrad/s"},
       {1e-3, "is the position in mrad"}}};
  for (const KnownFactor& one : known) {
    constexpr double error = 0.04;  // 2π and a gear of 6 differ by this
    if (std::abs(std::log(factor / one.size)) < error) return one.cause;
  }
  return "check their units, or a gear ratio between motor and joint";
}

std::string name_of(std::size_t servo) { return std::string(models::servo_names.at(servo)); }

}  // namespace

void JointMotionCheck::add(const CheckedWindow& window) {
  Vector velocity;
  Vector derivative;
  for (std::size_t i = 0; i < window.joint.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    velocity[row] = window.joint[i].velocity;
    derivative[row] = window.joint[i].position_change / window.duration;
  }
  if (!velocity.allFinite() || !derivative.allFinite()) return;
  ++windows_;
  products_ += velocity * derivative.transpose();
  velocity_squares_ += velocity.cwiseAbs2();
  derivative_squares_ += derivative.cwiseAbs2();
}

void JointMotionCheck::report(Findings& findings) const {
  if (windows_ < least_windows) return;
  const double least = least_speed * least_speed * windows_;
  for (int i = 0; i < models::servo_count; ++i) {
    const double velocity = velocity_squares_[i];
    const double derivative = derivative_squares_[i];
    const double servo_velocity = std::sqrt(velocity / windows_);
    const double servo_derivative = std::sqrt(derivative / windows_);
    if (std::max(velocity, derivative) < least || velocity == 0.0) continue;
    const auto correlation = [&](int j) {
      return products_(i, j) / std::sqrt(velocity * derivative_squares_[j]);
    };
    const std::string name = name_of(static_cast<std::size_t>(i));
    if (derivative == 0.0) continue;  // a position that never changes is named elsewhere
    const double own = correlation(i);
    const double factor = std::sqrt(velocity / derivative);
    if (own < -follows) {
      findings.add(name, "velocity has the other sign than the derivative of position");
    } else if (own > follows && std::abs(std::log(factor)) > std::log(largest_factor)) {
      findings.add(name, fmt::format("velocity is {:.2g} times the derivative of position: {}",
                                     factor, cause_of(factor)));
    } else if (own < unrelated && std::min(servo_velocity, servo_derivative) > least_speed) {
      int best = i;
      for (int j = 0; j < models::servo_count; ++j) {
        if (derivative_squares_[j] >= least && correlation(j) > correlation(best)) best = j;
      }
      findings.add(name,
                   best != i && correlation(best) > follows
                       ? fmt::format("velocity follows the position of {}: are joints in another "
                                     "order",
                                     name_of(static_cast<std::size_t>(best)))
                       : std::string("velocity does not follow the derivative of position: is it "
                                     "that of another joint, or commanded"));
    }
  }
}

}  // namespace touchdown::recordings
