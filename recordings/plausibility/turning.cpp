#include "recordings/plausibility/turning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace touchdown::recordings {

namespace {

/// Slower turns show the gyroscope's bias (0.05 rad/s per axis) and the attitude filter's error,
/// which adds 0.1 rad/s to a tenth of a second and 0.05 rad/s to half a second (harsh.yaml).
constexpr double least_fast_turn = 0.4;   // rad/s
constexpr double least_slow_turn = 0.25;  // rad/s
constexpr int half_second = 5;            // windows
constexpr int least_turn_windows = 5;
constexpr double turn_follows = 0.7;  // correlation
constexpr double largest_turn_factor = 1.6;

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

std::string cause_of_turn_factor(double factor) {
  // The attitude filter's error lowers the factor of a robot that turns slowly.
  const auto is_near = [&](double size) { return std::abs(std::log(factor / size)) < 0.5; };
  constexpr double degrees = 57.296;
  if (is_near(degrees)) return "is it in deg/s";
  if (is_near(1.0 / degrees)) return "was one in rad/s mapped as deg/s";
  if (is_near(1e3)) return "is it in mrad/s";
  return "check its unit and scale";
}

}  // namespace

void TurningComparison::add(const Eigen::Vector3d& gyroscope, const Eigen::Vector3d& orientation,
                            double least) {
  const double larger = std::max(gyroscope.norm(), orientation.norm());
  if (!(larger >= least) || !gyroscope.allFinite() || !orientation.allFinite()) return;
  ++windows;
  products += gyroscope * orientation.transpose();
  gyroscope_squares += gyroscope.squaredNorm();
  orientation_squares += orientation.squaredNorm();
}

void TurningCheck::add(const CheckedWindow& window) {
  fast_.add(window.angular_velocity, window.turn_rate, least_fast_turn);
  gyroscope_ += window.angular_velocity / half_second;
  orientation_ += window.turn_rate / half_second;
  if (++count_ < half_second) return;
  slow_.add(gyroscope_, orientation_, least_slow_turn);
  count_ = 0;
  gyroscope_.setZero();
  orientation_.setZero();
}

void TurningCheck::report(Findings& findings) const {
  const TurningComparison& turns = fast_.windows >= least_turn_windows ? fast_ : slow_;
  if (turns.windows < least_turn_windows || turns.gyroscope_squares == 0.0 ||
      turns.orientation_squares == 0.0) {
    return;
  }
  const auto add = [&](const std::string& finding) { findings.add("angular_velocity", finding); };
  const double norm = std::sqrt(turns.gyroscope_squares * turns.orientation_squares);
  const double factor = std::sqrt(turns.gyroscope_squares / turns.orientation_squares);
  const double correlation = turns.products.trace() / norm;
  const bool is_of_other_size = std::abs(std::log(factor)) > std::log(largest_turn_factor);
  if (correlation > turn_follows) {
    if (is_of_other_size) {
      add(fmt::format("is {:.2g} times the turning of the orientation: {}", factor,
                      cause_of_turn_factor(factor)));
    }
    return;
  }
  const Axes best = best_axes(turns.products);
  constexpr double much = 10.0;
  if (factor > much) {
    add(fmt::format("is {:.2g} times the turning of the orientation: {}", factor,
                    cause_of_turn_factor(factor)));
  } else if (correlation < -turn_follows) {
    add("turns the other way than the orientation: its sign is wrong, or the orientation is the "
        "inverse one (from the reference to the IMU)");
  } else if (fit(turns.products, best) > turn_follows * norm) {
    add(fmt::format("fits the orientation as {} of its axes: check axes and signs", text_of(best)));
  } else {
    add("does not follow the orientation: check axes, the order of the quaternion and its frames");
  }
}

}  // namespace touchdown::recordings
