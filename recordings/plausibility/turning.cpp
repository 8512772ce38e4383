#include "recordings/plausibility/turning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace touchdown::recordings {

namespace {

/// Slower turns show bias (0.05 rad/s) and the attitude filter's error (0.1 rad/s, harsh.yaml).
constexpr double least_turn = 0.4;  // rad/s
constexpr int least_windows = 5;
constexpr double follows = 0.7;  // correlation
constexpr double largest_factor = 1.6;

/// A rotation or reflection of axes: entry i is the gyroscope's axis that fits the orientation's
/// axis i, with its sign.
struct Axes {
  std::array<int, 3> axis;
  std::array<double, 3> sign;
};

double fit(const Eigen::Matrix3d& products, const Axes& axes) {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    sum += axes.sign[k] * products(axes.axis[k], i);
  }
  return sum;
}

Axes best_axes(const Eigen::Matrix3d& products) {
  std::array<int, 3> order = {0, 1, 2};
  Axes best{order, {1.0, 1.0, 1.0}};
  do {
    Axes axes{order, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      axes.sign[i] = products(order[i], static_cast<Eigen::Index>(i)) < 0.0 ? -1.0 : 1.0;
    }
    if (fit(products, axes) > fit(products, best)) best = axes;
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

std::string text_of(const Axes& axes) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 3; ++i) {
    names.push_back(std::string(axes.sign[i] < 0.0 ? "-" : "") +
                    "xyz"[static_cast<std::size_t>(axes.axis[i])]);
  }
  return fmt::format("[{}]", fmt::join(names, ", "));
}

std::string cause_of(double factor) {
  const auto is_near = [&](double size) { return std::abs(std::log(factor / size)) < 0.25; };
  constexpr double degrees = 57.296;
  if (is_near(degrees)) return "is it in deg/s";
  if (is_near(1.0 / degrees)) return "was one in rad/s mapped as deg/s";
  if (is_near(1e3)) return "is it in mrad/s";
  return "check its unit and scale";
}

}  // namespace

void TurningCheck::add(const CheckedWindow& window) {
  const Eigen::Vector3d& gyroscope = window.angular_velocity;
  const Eigen::Vector3d& orientation = window.turn_rate;
  const double larger = std::max(gyroscope.norm(), orientation.norm());
  if (!(larger >= least_turn) || !gyroscope.allFinite() || !orientation.allFinite()) return;
  ++windows_;
  products_ += gyroscope * orientation.transpose();
  gyroscope_squares_ += gyroscope.squaredNorm();
  orientation_squares_ += orientation.squaredNorm();
}

void TurningCheck::report(Findings& findings) const {
  if (windows_ < least_windows || gyroscope_squares_ == 0.0) return;
  const auto add = [&](const std::string& finding) { findings.add("angular_velocity", finding); };
  const double norm = std::sqrt(gyroscope_squares_ * orientation_squares_);
  const double factor = std::sqrt(gyroscope_squares_ / orientation_squares_);
  const double correlation = products_.trace() / norm;
  const bool is_of_other_size = std::abs(std::log(factor)) > std::log(largest_factor);
  if (correlation > follows) {
    if (is_of_other_size) {
      add(fmt::format("is {:.2g} times the turning of the orientation: {}", factor,
                      cause_of(factor)));
    }
    return;
  }
  const Axes best = best_axes(products_);
  if (correlation < -follows) {
    add("turns the other way than the orientation: its sign is wrong, or the orientation is the "
        "inverse one (from the reference to the IMU)");
  } else if (fit(products_, best) > follows * norm) {
    add(fmt::format("fits the orientation as {} of its axes: check axes and signs", text_of(best)));
  } else if (factor > 10.0) {
    add(fmt::format("is {:.2g} times the turning of the orientation: {}", factor,
                    cause_of(factor)));
  } else {
    add("does not follow the orientation: check axes, the order of the quaternion and its frames");
  }
}

}  // namespace touchdown::recordings
