#include <cmath>

#include <fmt/format.h>

#include "estimator/record.hpp"
#include "logs/plausibility/rules.hpp"

namespace touchdown::logs {

namespace {

/// The bias of a bad accelerometer (1 m/s²) and gravity along a bad orientation (0.1 rad, 1 m/s²)
/// leave half of this.
constexpr double largest_linear = 4.0;  // m/s²
/// Bias and scale of a bad accelerometer change gravity by a tenth at most.
constexpr double proper_tolerance = 0.2;  // of gravity
/// Mounting and orientation of bad sensors differ by 0.1 rad.
constexpr double largest_angle = 0.4;  // rad

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

bool is_near(double value, double expected, double share) {
  return std::abs(value - expected) <= share * expected;
}

}  // namespace

void GravityCheck::add_still(const CheckedWindow& stretch) {
  if (stretch.up.hasNaN() || stretch.linear_acceleration.hasNaN()) return;
  ++stretches_;
  linear_ += stretch.linear_acceleration;
  up_ += stretch.up;
  // A log without proper acceleration gets it from the linear one; it then adds nothing.
  const Eigen::Vector3d derived = stretch.linear_acceleration + gravity_at_rest * stretch.up;
  const Eigen::Vector3d& proper = stretch.proper_acceleration;
  constexpr double rounding = 0.3;  // m/s²: the orientation changes within the stretch
  if (proper.hasNaN() || proper.isZero(0.0) || (proper - derived).norm() < rounding) return;
  ++proper_stretches_;
  proper_ += proper;
  proper_up_ += stretch.up;
}

void GravityCheck::report(Findings& findings) const {
  if (stretches_ == 0) return;
  report_linear(findings);
  if (proper_stretches_ > 0) report_proper(findings);
}

void GravityCheck::report_linear(Findings& findings) const {
  const Eigen::Vector3d mean = linear_ / stretches_;
  const double size = mean.norm();
  const bool points_up = angle_between(mean, up_) < largest_angle;
  const auto add = [&](const std::string& finding) {
    findings.add("linear_acceleration", finding);
  };
  constexpr double in_g = 1.0;
  if (points_up && is_near(size, in_g, 0.05)) {
    add("holds gravity in g: mean 1.0 upwards while the robot is still: map it as "
        "proper_acceleration with unit g");
  } else if (size > largest_linear && is_near(size, gravity_at_rest, proper_tolerance)) {
    add(
        fmt::format("holds gravity: mean {:.1f} m/s² while the robot is still: map it as "
                    "proper_acceleration, or let the driver remove gravity",
                    size));
  } else if (size > largest_linear) {
    add(
        fmt::format("mean {:.1f} m/s² while the robot is still, expected 0: gravity was removed by "
                    "a wrong orientation (order, reference or axes), or the unit is wrong",
                    size));
  }
}

void GravityCheck::report_proper(Findings& findings) const {
  const Eigen::Vector3d mean = proper_ / proper_stretches_;
  const double size = mean.norm();
  const auto add = [&](const std::string& finding) {
    findings.add("proper_acceleration", finding);
  };
  if (!is_near(size, gravity_at_rest, proper_tolerance)) {
    const double share = size / gravity_at_rest;
    const char* cause = share < 0.05 ? "gravity was removed: map it as linear_acceleration"
                        : is_near(size, 1.0, 0.1)   ? "is it in g"
                        : is_near(share, 1e3, 0.2)  ? "is it in mm/s²"
                        : is_near(size, 1e3, 0.1)   ? "is it in mg"
                        : is_near(share, 9.81, 0.2) ? "it was converted from g twice"
                                                    : "is its unit or scale wrong";
    add(fmt::format("mean {:.3g} m/s² while the robot is still, expected 9.8: {}", size, cause));
    return;
  }
  const double angle = angle_between(mean, proper_up_);
  if (angle > largest_angle) {
    add(
        fmt::format("points {:.0f}° away from the orientation's upward vertical while the robot is "
                    "still: check order, reference and axes of the orientation",
                    angle * 180.0 / 3.14159265358979323846));
  }
}

}  // namespace touchdown::logs
