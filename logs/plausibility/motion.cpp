#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "logs/plausibility/rules.hpp"

namespace touchdown::logs {

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

}  // namespace touchdown::logs
