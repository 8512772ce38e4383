#include "logs/plausibility/relations.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "estimator/record.hpp"

namespace touchdown::logs {

Relation::Relation(int size, double least)
    : least_(least),
      products_(Eigen::MatrixXd::Zero(size, size)),
      measured_(Eigen::VectorXd::Zero(size)),
      predicted_(measured_),
      measured_squares_(measured_),
      predicted_squares_(measured_) {}

void Relation::add(const Eigen::VectorXd& measured, const Eigen::VectorXd& predicted) {
  if (!measured.allFinite() || !predicted.allFinite()) return;
  if (std::max(measured.norm(), predicted.norm()) < least_) return;
  ++windows_;
  products_ += measured * predicted.transpose();
  measured_ += measured;
  predicted_ += predicted;
  measured_squares_ += measured.cwiseAbs2();
  predicted_squares_ += predicted.cwiseAbs2();
}

double Relation::measured(int axis) const {
  return std::sqrt(measured_squares_[axis] / std::max(1, windows_));
}

double Relation::predicted(int axis) const {
  return std::sqrt(predicted_squares_[axis] / std::max(1, windows_));
}

double Relation::correlation(int measured, int predicted) const {
  const double squares = measured_squares_[measured] * predicted_squares_[predicted];
  return squares > 0.0 ? products_(measured, predicted) / std::sqrt(squares) : 0.0;
}

double Relation::spread(int measured, int predicted) const {
  return products_(measured, predicted) - measured_[measured] * predicted_[predicted] / windows_;
}

double Relation::covariation(int measured, int predicted) const {
  const double of_measured =
      measured_squares_[measured] - std::pow(measured_[measured], 2) / windows_;
  const double of_predicted =
      predicted_squares_[predicted] - std::pow(predicted_[predicted], 2) / windows_;
  const double squares = of_measured * of_predicted;
  return of_measured > 0.0 && of_predicted > 0.0 ? spread(measured, predicted) / std::sqrt(squares)
                                                 : 0.0;
}

double Relation::slope(int measured, int predicted) const {
  return spread(measured, predicted) /
         (predicted_squares_[predicted] - std::pow(predicted_[predicted], 2) / windows_);
}

double Relation::deviation(int measured) const {
  const double mean = measured_[measured] / windows_;
  return std::sqrt(std::max(0.0, measured_squares_[measured] / windows_ - mean * mean));
}

double Relation::difference(int measured, int predicted) const {
  const double mean = (measured_[measured] - predicted_[predicted]) / windows_;
  const double squares = measured_squares_[measured] + predicted_squares_[predicted] -
                         2.0 * products_(measured, predicted);
  return std::sqrt(std::max(0.0, squares / windows_ - mean * mean));
}

double Relation::factor() const {
  return std::sqrt(measured_squares_.sum() / predicted_squares_.sum());
}

double Relation::agreement() const {
  return products_.trace() / std::sqrt(measured_squares_.sum() * predicted_squares_.sum());
}

Relation::Axes Relation::best() const {
  std::vector<int> order(static_cast<std::size_t>(products_.cols()));
  std::iota(order.begin(), order.end(), 0);
  Axes best{{}, {}, -1.0};
  const double norm = std::sqrt(measured_squares_.sum() * predicted_squares_.sum());
  do {
    Axes axes{order, {}, 0.0};
    for (int i = 0; const int axis : order) {
      const double product = products_(axis, i++);
      axes.sign.push_back(product < 0.0 ? -1.0 : 1.0);
      axes.fit += std::abs(product) / norm;
    }
    if (axes.fit > best.fit) best = axes;
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

namespace {

struct UnitFactor {
  const char* quantity;
  double size;  ///< measured / predicted
  const char* cause;
};

constexpr double radian = 57.296;
constexpr double revolution = 6.2832;
constexpr UnitFactor unit_factors[] = {
    {"rate", radian, "is the velocity in deg/s"},
    {"rate", 1.0 / radian, "is the position in deg, or was a velocity in rad/s mapped as deg/s"},
    {"rate", 9.5493, "is the velocity in rpm"},
    {"rate", 1.0 / 9.5493, "was a velocity in rad/s mapped as rpm"},
    {"rate", 1.0 / revolution, "is the velocity in rev/s"},
    {"rate", revolution, "is the position in rev, or was a velocity in rad/s mapped as rev/s"},
    {"rate", 1e3, "is the velocity in mrad/s"},
    {"rate", 1e-3, "is the position in mrad"},
    {"turn", radian, "is it in deg/s"},
    {"turn", 1.0 / radian, "was one in rad/s mapped as deg/s"},
    {"turn", 1e3, "is it in mrad/s"},
    {"acceleration", 1.0 / gravity_at_rest, "is it in g"},
    {"acceleration", 1e3, "is it in mm/s²"},
    {"acceleration", 1e3 / gravity_at_rest, "is it in mg"},
    {"acceleration", gravity_at_rest, "it was converted from g twice"},
    {"torque", 1e3, "mN·m (N·mm)"},
    {"torque", 141.6, "ozf·in"},
    {"torque", 1e2, "cN·m"},
    {"torque", 10.2, "kgf·cm"},
    {"torque", 8.85, "lbf·in"},
};

}  // namespace

std::string cause_of(const char* quantity, double factor, double error, const char* otherwise) {
  const UnitFactor* best = nullptr;
  double least = error;
  for (const UnitFactor& one : unit_factors) {
    const double apart = std::abs(std::log(factor / one.size));
    if (std::strcmp(one.quantity, quantity) != 0 || !(apart < least)) continue;
    least = apart;
    best = &one;
  }
  return best == nullptr ? otherwise : best->cause;
}

namespace {

/// Slower joints show resolution, bias and delay of their sensors rather than their motion.
constexpr double least_speed = 0.3;  // rad/s, root mean square of windows
constexpr int least_windows = 10;    // a second
/// Delays and low-passes of tens of milliseconds lower both.
constexpr double follows = 0.7;
constexpr double unrelated = 0.4;
/// A velocity behind a low-pass is smaller than the derivative; attitude filters err.
constexpr double largest_factor = 1.6;
/// A velocity that follows so closely is behind no low-pass of this effect.
constexpr double precisely = 0.98;
constexpr double largest_precise_factor = 1.25;

/// Slower turns show the gyroscope's bias (0.05 rad/s per axis) and the attitude filter's error,
/// which adds 0.1 rad/s to a tenth of a second and 0.05 rad/s to half a second (harsh.yaml).
constexpr double least_fast_turn = 0.4;   // rad/s
constexpr double least_slow_turn = 0.25;  // rad/s
constexpr double least_axis_turn = 0.1;   // rad/s, root mean square
constexpr int least_turn_windows = 5;
constexpr std::size_t half_second = 5;  // windows
constexpr std::array axis_names = {" x", " y", " z"};

constexpr int left_wheel = 2;
constexpr int right_wheel = 5;

/// Slower wheels and faster turns do not show whether the wheels roll the same way.
constexpr double least_wheel_speed = 1.0;      // rad/s
constexpr double fastest_straight_turn = 0.3;  // rad/s
constexpr int least_accelerations = 30;
/// A robot that is lifted or hangs has up to 0.6 of either sign; one that drives 0.75 to 0.99.
constexpr double drive_follows = 0.75;
/// A robot that swings below its hook follows its wheels, too, but by 0.016 m instead of
/// 0.028 to 0.045 m, nearly the radius of Upkie's wheels.
constexpr double least_radius = 0.025;            // m
constexpr double least_wheel_acceleration = 0.4;  // rad/s², root mean square

/// Errors of positions, which the servo's own encoder does not have (noise/profiles/harsh.yaml).
constexpr double position_error = 0.1;    // rad
constexpr double law_torque_error = 0.3;  // N·m
constexpr double law_share_error = 0.5;   // of the measured torque
/// Motors of closed legs turn up to 5 times as much as the joints that a log has.
constexpr double largest_law_ratio = 6.0;
constexpr double least_law_motion = 0.1;  // N·m, standard deviation
constexpr double law_follows = 0.9;       // correlation
constexpr double law_explains = 0.5;      // the other joint's torque differs by less of its own

/// The bias of a bad accelerometer (1 m/s²) and gravity along a bad orientation (0.1 rad, 1 m/s²)
/// leave half of this.
constexpr double largest_linear = 4.0;  // m/s²
/// Bias and scale of a bad accelerometer change gravity by a tenth at most.
constexpr double proper_tolerance = 0.2;  // of gravity
/// Mounting and orientation of bad sensors differ by 0.1 rad.
constexpr double largest_angle = 0.4;  // rad

std::string name_of(int servo) {
  return std::string(models::servo_names.at(static_cast<std::size_t>(servo)));
}

/// Speed of the wheels forwards (rad/s): the right one counts the other way.
double forward_speed(const CheckedWindow& window) {
  return 0.5 * (window.joint[left_wheel].velocity - window.joint[right_wheel].velocity);
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

bool is_near(double value, double expected, double share) {
  return std::abs(value - expected) <= share * expected;
}

}  // namespace

Relations::Turning::Turning() : windows(3, least_fast_turn), half_seconds(3, least_slow_turn) {}

bool Relations::Turning::is_fast() const { return windows.windows() >= least_turn_windows; }

bool Relations::Turning::is_known() const {
  return is_fast() || half_seconds.windows() >= least_turn_windows * static_cast<int>(half_second);
}

Relations::Relations(const QuaternionReading& reading)
    : velocity_(models::servo_count),
      exchanged_(models::servo_count),
      wheels_(1, least_wheel_speed),
      acceleration_(3),
      proper_(3),
      linear_(3),
      targets_(models::servo_count, Relation(2)),
      reading_(reading) {}

void Relations::add(const CheckedWindow& window) {
  Eigen::VectorXd velocity(models::servo_count);
  Eigen::VectorXd derivative(models::servo_count);
  Eigen::VectorXd position(models::servo_count);
  Eigen::VectorXd acceleration(models::servo_count);
  for (int i = 0; i < models::servo_count; ++i) {
    const CheckedWindow::Joint& joint = window.joint[static_cast<std::size_t>(i)];
    velocity[i] = joint.velocity;
    derivative[i] = joint.position_change / window.duration;
    position[i] = joint.position;
    acceleration[i] = joint.velocity_change / window.duration;
  }
  velocity_.add(velocity, derivative);
  exchanged_.add(position, acceleration);
  turning_.windows.add(window.angular_velocity, window.turn_rate);
  other_turning_.windows.add(window.angular_velocity, window.other_turn_rate);
  if (window.up.allFinite()) {
    up_ += window.up;
    ++oriented_;
  }
  if (std::abs(window.angular_velocity.dot(window.up)) < fastest_straight_turn) {
    wheels_.add(Eigen::VectorXd::Constant(1, -window.joint[right_wheel].velocity),
                Eigen::VectorXd::Constant(1, window.joint[left_wheel].velocity));
  }
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const CheckedWindow::Joint& joint = window.joint[i];
    // The law of a wheel has no position, and estimators do not use it.
    if (i % 3 == 2 || !(joint.kp > 0.0)) continue;
    if (joint.position == 0.0 && joint.torque == 0.0) continue;  // the robot lacks it
    const std::size_t other = i % 3 == 0 ? i + 1 : i - 1;
    const Eigen::Vector2d measured(joint.torque, window.joint[other].torque);
    if (!measured.allFinite() || !std::isfinite(joint.law[0])) continue;
    targets_[i].add(measured, Eigen::Vector2d(joint.law[0], joint.kp));
    const double most =
        law_torque_error + law_share_error * std::abs(joint.torque) + position_error * joint.kp;
    for (std::size_t k = 0; k < joint.law.size(); ++k) {
      if (!(std::abs(joint.law[k] - joint.torque) <= most)) ++apart_[i][k];
    }
  }
  add_driving(window);
}

void Relations::add_driving(const CheckedWindow& window) {
  const bool is_whole =
      std::isfinite(forward_speed(window)) && window.linear_acceleration.allFinite();
  const bool continues = !last_.empty() && std::abs(window.start - last_.back().start -
                                                    last_.back().duration) < 0.5 * window.duration;
  if (!is_whole || !continues) last_.clear();
  if (!is_whole) return;
  last_.push_back(window);
  if (last_.size() <= half_second) return;
  const double duration = last_.back().start - last_.front().start;
  const double wheels = (forward_speed(last_.back()) - forward_speed(last_.front())) / duration;
  // The change of a mean over windows is the mean acceleration with half weights at both ends.
  Eigen::Vector3d imu =
      0.5 * (last_.front().linear_acceleration + last_.back().linear_acceleration);
  Eigen::Vector3d gyroscope = Eigen::Vector3d::Zero();
  Eigen::Vector3d orientation = Eigen::Vector3d::Zero();
  Eigen::Vector3d other_order = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i < half_second; ++i) imu += last_[i].linear_acceleration;
  for (std::size_t i = 0; i < half_second; ++i) {
    gyroscope += last_[i].angular_velocity / half_second;
    orientation += last_[i].turn_rate / half_second;
    other_order += last_[i].other_turn_rate / half_second;
  }
  acceleration_.add(imu / half_second, Eigen::Vector3d::Constant(wheels));
  turning_.half_seconds.add(gyroscope, orientation);
  other_turning_.half_seconds.add(gyroscope, other_order);
  last_.erase(last_.begin());
}

void Relations::add_still(const CheckedWindow& stretch) {
  const Eigen::Vector3d gravity = gravity_at_rest * stretch.up;
  linear_.add(stretch.linear_acceleration, gravity);
  if (!stretch.proper_acceleration.isZero(0.0)) proper_.add(stretch.proper_acceleration, gravity);
}

void Relations::report(Findings& findings, bool measures_acceleration) const {
  const bool has_velocities = report_velocities(findings);
  report_targets(findings);
  if (is_other_order()) {
    findings.add(
        "orientation",
        fmt::format("turns as the gyroscope does if its numbers are {}: they were read as {}",
                    reading_.is_w_last ? "w, x, y, z" : "x, y, z, w",
                    reading_.is_w_last ? "x, y, z, w" : "w, x, y, z"));
    return;  // the vertical, and accelerations without gravity, are wrong by it
  }
  report_turning(findings);
  const bool has_acceleration = report_gravity(findings, measures_acceleration);
  report_driving(findings, has_acceleration, has_velocities);
}

bool Relations::is_other_order() const {
  if (!turning_.is_known() || !other_turning_.is_known()) return false;
  constexpr double better = 0.3;
  const double own = turning_.relation().agreement();
  const double other = other_turning_.relation().agreement();
  // A robot that only pitches turns the other way in the other order, as with a gyroscope of the
  // other sign.
  return own > -follows && other > std::max(follows, own + better);
}

bool Relations::report_velocities(Findings& findings) const {
  bool are_wheels_right = true;
  if (velocity_.windows() < least_windows) return are_wheels_right;
  for (int i = 0; i < models::servo_count; ++i) {
    const double velocity = velocity_.measured(i);
    const double derivative = velocity_.predicted(i);
    // A position or velocity that never changes is named elsewhere.
    if (std::max(velocity, derivative) < least_speed || velocity * derivative == 0.0) continue;
    const double own = velocity_.correlation(i, i);
    const double factor = velocity / derivative;
    const double most = own > precisely ? largest_precise_factor : largest_factor;
    const bool is_of_other_size = std::abs(std::log(factor)) > std::log(most);
    const double exchanged = exchanged_.measured(i) / exchanged_.predicted(i);
    const bool fits_exchanged = exchanged_.correlation(i, i) > follows &&
                                std::abs(std::log(exchanged)) < std::log(largest_factor);
    const auto add = [&](const std::string& finding) {
      findings.add(name_of(i), finding);
      are_wheels_right = are_wheels_right && i != left_wheel && i != right_wheel;
    };
    if (own < follows && fits_exchanged && (own > -follows || is_of_other_size)) {
      add("position follows the derivative of velocity: are the two exchanged");
    } else if (own < -follows) {
      add("velocity has the other sign than the derivative of position");
    } else if (own > follows && is_of_other_size) {
      constexpr double error = 0.04;  // 2π and a gear of 6 differ by this
      add(fmt::format("velocity is {} times the derivative of position: {}", readable(factor, 2),
                      cause_of("rate", factor, error,
                               "check their units, a gear ratio between motor and joint, or the "
                               "unit of time")));
    } else if (own < unrelated && std::min(velocity, derivative) > least_speed) {
      int best = i;
      for (int j = 0; j < models::servo_count; ++j) {
        const bool moves = velocity_.predicted(j) >= least_speed;
        if (moves && velocity_.correlation(i, j) > velocity_.correlation(i, best)) best = j;
      }
      add(best != i && velocity_.correlation(i, best) > follows
              ? fmt::format("velocity follows the position of {}: are joints in another order",
                            name_of(best))
              : "velocity does not follow the derivative of position: is it that of another "
                "joint, or commanded");
    }
  }
  return are_wheels_right;
}

void Relations::report_targets(Findings& findings) const {
  constexpr std::array<const char*, 4> causes = {
      "check signs, units and gains of the targets, and the order of joints",
      "they or the positions probably have the other sign",
      "they or the positions are probably those of the other leg", "they are probably in degrees"};
  // Constant errors of positions do not matter here.
  const auto fits_the_other = [&](int joint) {
    const Relation& relation = targets_[static_cast<std::size_t>(joint)];
    if (relation.windows() < least_windows) return false;
    const double own = relation.difference(0, 0);
    return own > least_law_motion && relation.difference(1, 0) < law_explains * own;
  };
  for (int i = 0; i < models::servo_count; ++i) {
    const Relation& relation = targets_[static_cast<std::size_t>(i)];
    if (relation.windows() < least_windows) continue;
    const auto& apart = apart_[static_cast<std::size_t>(i)];
    const std::string subject = fmt::format("targets of {}", name_of(i));
    if (2 * apart[0] > relation.windows()) {
      const auto best = std::min_element(apart.begin() + 1, apart.end()) - apart.begin();
      const bool explains = 4 * apart.at(static_cast<std::size_t>(best)) < relation.windows();
      findings.add(subject, fmt::format("do not give the measured torques by the servo's law: {}",
                                        causes.at(explains ? static_cast<std::size_t>(best) : 0)));
      continue;
    }
    if (fits_the_other(i) && fits_the_other(i % 3 == 0 ? i + 1 : i - 1)) {
      findings.add(subject,
                   "give the torque of the knee at the hip by the servo's law, and the "
                   "other way round: the torques of hips and knees are probably exchanged");
      continue;
    }
    const double follows_law = relation.covariation(0, 0);
    const double ratio = follows_law / relation.slope(0, 0);
    const double motion = relation.deviation(0);
    if (!(motion > least_law_motion && follows_law > law_follows)) continue;
    if (ratio <= largest_law_ratio && ratio >= 1.0 / largest_law_ratio) continue;
    // A delay of 5 ms at 1 rad/s shows with large gains.
    const double error = 0.005 * relation.predicted(1);
    if (ratio > 1.0 && (ratio - largest_law_ratio) * motion < error) continue;
    findings.add(subject, fmt::format("give {} times the measured torques by the servo's law: "
                                      "check the unit and scale of the gains",
                                      readable(ratio, 2)));
  }
}

void Relations::report_turning(Findings& findings) const {
  if (!turning_.is_known()) return;
  const Relation& turns = turning_.relation();
  const double factor = turns.factor();
  constexpr double never = 1e6;  // an orientation that stands still is named elsewhere
  if (!(factor > 0.0 && factor < never)) return;
  const auto add = [&](const std::string& finding, const char* axis = "") {
    findings.add(fmt::format("angular_velocity{}", axis), finding);
  };
  // The attitude filter's error lowers the factor of a robot that turns slowly.
  const auto times = [](double size) {
    return fmt::format("is {} times the turning of the orientation: {}", readable(size, 2),
                       cause_of("turn", size, 0.5, "check its unit and scale"));
  };
  const bool is_of_other_size = std::abs(std::log(factor)) > std::log(largest_factor);
  constexpr double much = 10.0;
  // One axis in another unit hides the others.
  std::vector<int> large;
  for (int i = 0; i < 3; ++i) {
    if (turns.measured(i) > much * std::max(0.02, turns.predicted(i))) large.push_back(i);
  }
  const double own = turns.agreement();
  if (!large.empty() && large.size() < 3 && factor > largest_factor) {
    for (const int i : large) {
      add(times(turns.measured(i) / turns.predicted(i)),
          axis_names.at(static_cast<std::size_t>(i)));
    }
  } else if (own > follows) {
    if (is_of_other_size) add(times(factor));
    // A robot that turns about one axis hides the sign of the others from the whole vector.
    for (int i = 0; i < 3; ++i) {
      const bool turns_here = std::min(turns.measured(i), turns.predicted(i)) > least_axis_turn;
      if (!turns_here || turns.correlation(i, i) > -follows) continue;
      add("turns the other way than the orientation: is its sign wrong",
          axis_names.at(static_cast<std::size_t>(i)));
    }
  } else if (factor > much) {
    add(times(factor));
  } else if (own < -follows) {
    add("turns the other way than the orientation: its sign is wrong, the quaternion has another "
        "`order`, or it is the inverse one (from the reference to the IMU)");
  } else if (const Relation::Axes best = turns.best(); best.fit > follows) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < 3; ++i) {
      names.push_back(fmt::format("{}{}", best.sign[i] < 0.0 ? "-" : "",
                                  "xyz"[static_cast<std::size_t>(best.order[i])]));
    }
    add(fmt::format("fits the orientation as [{}] of its axes: check axes and signs",
                    fmt::join(names, ", ")));
  } else {
    add("does not follow the orientation: check axes, the order of the quaternion and its frames");
  }
}

bool Relations::report_gravity(Findings& findings, bool measures_acceleration) const {
  const auto linear = [&](const std::string& finding) {
    findings.add("linear_acceleration", finding);
    return false;
  };
  const auto proper = [&](const std::string& finding) {
    findings.add("proper_acceleration", finding);
    return false;
  };
  if (oriented_ > 0 && !is_upright()) {
    findings.add("orientation",
                 fmt::format("has the robot {}: is the IMU mounted so, or its z axis not the one "
                             "that points down? Check axes, reference and order",
                             up_.z() > 0.5 * oriented_ ? "upside down" : "lie on its side"));
  }
  if (!measures_acceleration || linear_.windows() == 0) return measures_acceleration;
  const Eigen::Vector3d up = linear_.predicted_mean();
  const Eigen::Vector3d mean = linear_.measured_mean();
  const double size = mean.norm();
  const bool has_proper = proper_.windows() > 0;
  Eigen::Vector3d measured = mean + up;
  if (has_proper) measured = proper_.measured_mean();
  const double of_proper = measured.norm();
  // A log without proper acceleration gets it from the linear one, or the other way round.
  const bool is_derived = has_proper && (measured - mean - up).norm() < 0.3;
  const bool is_off = has_proper && !is_near(of_proper, gravity_at_rest, proper_tolerance);
  const bool points_up = angle_between(mean, up) < largest_angle;
  if (points_up && is_near(size, 1.0, 0.05)) {
    return linear(
        "holds gravity in g: mean 1.0 upwards while the robot is still: map it as "
        "proper_acceleration with unit g");
  }
  const bool holds = size > largest_linear && is_near(size, gravity_at_rest, proper_tolerance);
  if (holds && points_up) {
    return linear(
        fmt::format("holds gravity: mean {:.1f} m/s² while the robot is still: map it as "
                    "proper_acceleration, or let the driver remove gravity",
                    size));
  }
  const double share = of_proper / gravity_at_rest;
  const bool has_cause = share < 0.05 || !cause_of("acceleration", share, 0.2, "").empty();
  if (is_off && (has_cause || !is_derived)) {
    return proper(fmt::format(
        "mean {} m/s² while the robot is still, expected 9.8: {}", readable(of_proper, 3),
        share < 0.05 ? "gravity was removed: map it as linear_acceleration"
                     : cause_of("acceleration", share, 0.2, "is its unit or scale wrong")));
  }
  if (size > largest_linear && (is_off || !is_derived)) {
    return linear(
        fmt::format("mean {:.1f} m/s² while the robot is still, expected 0: gravity was removed by "
                    "a wrong orientation (order, reference or axes), or the unit is wrong",
                    size));
  }
  const double angle = angle_between(measured, up);
  if (angle <= largest_angle) return true;
  return proper(
      fmt::format("points {:.0f}° away from the orientation's upward vertical while the robot is "
                  "still: check order, reference and axes of the orientation",
                  angle * 180.0 / std::numbers::pi));
}

bool Relations::wheels_oppose() const {
  // Robots that drive straight have more than 0.9, and those of which one leg counts the other way
  // less than −0.9.
  return wheels_.windows() >= least_windows && wheels_.agreement() < -follows;
}

bool Relations::drives() const {
  if (acceleration_.windows() < least_accelerations || wheels_oppose()) return false;
  return acceleration_.predicted(0) > least_wheel_acceleration &&
         std::abs(acceleration_.covariation(0, 0)) > drive_follows &&
         std::abs(acceleration_.slope(0, 0)) > least_radius;
}

void Relations::report_driving(Findings& findings, bool has_acceleration,
                               bool has_velocities) const {
  if (wheels_oppose()) {
    findings.add("wheels",
                 "turn in opposite directions although the robot does not turn: on Upkie the right "
                 "leg is the mirror image; if both legs count the same way, map the right one with "
                 "sign -1");
    return;
  }
  if (!has_acceleration || acceleration_.windows() < least_accelerations) return;
  // The IMU's x axis points back.
  if (drives() && acceleration_.covariation(0, 0) > 0.0) {
    findings.add("wheels",
                 "drive backwards while the IMU accelerates forwards: are left and right swapped, "
                 "do all joints count the other way, or does the IMU's x axis point forwards");
  }
  constexpr double clearly = 0.85;
  constexpr double smallest_wheel = 0.008;  // m
  constexpr double largest_wheel = 0.3;     // m
  const double radius = std::abs(acceleration_.slope(0, 0));
  if (has_velocities && std::abs(acceleration_.covariation(0, 0)) > clearly &&
      acceleration_.predicted(0) > least_wheel_acceleration &&
      (radius < smallest_wheel || radius > largest_wheel)) {
    findings.add(
        "linear_acceleration",
        fmt::format("follows the wheels as if their radius were {} m: {}", readable(radius, 2),
                    radius < smallest_wheel
                        ? "is it in g"
                        : "was it converted from g twice, or are the wheels in rev"));
  }
  const bool moves = acceleration_.predicted(0) > least_wheel_acceleration;
  if (moves && std::abs(acceleration_.covariation(0, 0)) < unrelated &&
      std::abs(acceleration_.covariation(1, 0)) > clearly &&
      std::abs(acceleration_.slope(1, 0)) > least_radius) {
    findings.add("linear_acceleration",
                 "its y axis follows the wheels, its x axis does not: check the IMU's axes");
  }
}

}  // namespace touchdown::logs
