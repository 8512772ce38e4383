#include "logs/plausibility/lateness.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <fmt/format.h>

namespace touchdown::logs {

namespace {

/// A regression of the first quantity on the next ones.
struct Regression {
  double unexplained = 0.0;  ///< sum of squares
  Eigen::VectorXd factors;
};

Regression regression(const Eigen::Matrix<double, 6, 6>& products, int causes) {
  Eigen::MatrixXd squares = products.block(1, 1, causes, causes);
  // A robot without hips has rows of zeros.
  squares.diagonal().array() += 1e-9 * products.trace();
  const Eigen::VectorXd both = products.block(1, 0, causes, 1);
  const Eigen::VectorXd factors = squares.ldlt().solve(both);
  return {products(0, 0) - both.dot(factors), factors};
}

}  // namespace

Lateness::Lateness(double period)
    : length_(std::max<std::int64_t>(1, std::llround(0.01 / period))),
      step_(static_cast<double>(length_) * period) {
  products_.fill(Eigen::Matrix<double, 6, 6>::Zero());
}

void Lateness::add(const models::Observation& record) {
  constexpr double longest_gap = 0.1;  // s
  const bool continues = record.time >= time_ && record.time - time_ < longest_gap;
  time_ = record.time;
  if (!continues) {
    count_ = 0;
    sum_.setZero();
    means_.clear();
    steps_.clear();
  }
  // The right leg is the mirror image of the left one.
  const auto forward = [&](std::size_t joint) {
    return 0.5 * (record.servo[joint].velocity - record.servo[joint + 3].velocity);
  };
  const double hips = forward(0);
  const double knees = forward(1);
  Step step;
  step << hips + knees + forward(2), hips, knees, -record.imu.linear_acceleration.x(),
      record.imu.linear_acceleration.z(), record.imu.angular_velocity.y();
  if (!step.allFinite()) return;
  sum_ += step;
  if (++count_ < length_) return;
  means_.emplace_back(sum_ / static_cast<double>(length_));
  count_ = 0;
  sum_.setZero();
  add_step();
}

void Lateness::add_step() {
  if (means_.size() <= span) return;
  Step step = (means_.back() - means_.front()) / (step_ * span);
  // The change of a mean is the mean acceleration with half weights at both ends.
  Step mean = 0.5 * (means_.front() + means_.back());
  for (std::size_t i = 1; i < span; ++i) mean += means_[i];
  step.segment<2>(3) = mean.segment<2>(3) / span;
  means_.pop_front();
  steps_.push_back(step);
  if (steps_.size() < delays) return;
  ++total_;
  Step both = steps_[most];
  for (std::size_t i = 0; i < delays; ++i) {
    both.tail<3>() = steps_[i].tail<3>();
    products_.at(i) += both * both.transpose();
  }
  steps_.pop_front();
}

Lateness::Fit Lateness::fit(int delay) const {
  const Eigen::Matrix<double, 6, 6>& products =
      products_.at(static_cast<std::size_t>(most + delay));
  const double of_joints = regression(products, 2).unexplained;
  if (!(of_joints > 0.0)) return {};
  const Regression of_all = regression(products, 5);
  return {1.0 - of_all.unexplained / of_joints, of_all.factors[2]};
}

void Lateness::report(Findings& findings) const {
  constexpr int least_steps = 300;
  constexpr double least_acceleration = 0.4;  // rad/s², root mean square of the wheels
  if (total_ < least_steps) return;
  if (products_[most](0, 0) < least_acceleration * least_acceleration * total_) return;
  int best = 0;
  for (int delay = -most; delay <= most; ++delay) {
    if (fit(delay).explained > fit(best).explained) best = delay;
  }
  // Sensors have delays of 10 ms, and a robot that hops adds 30 ms.
  constexpr int largest_delay = 4;  // steps
  constexpr double follows = 0.6;
  constexpr double clearly = 0.5;  // of what is unexplained without a delay
  // Wheels in the air move the robot less, as if they were smaller, and before the IMU.
  constexpr double least_radius = 0.03;  // m
  const auto [explained, turns_per_metre] = fit(best);
  if (std::abs(best) <= largest_delay || std::abs(best) == most || explained < follows) return;
  if (1.0 - explained > clearly * (1.0 - fit(0).explained)) return;
  // A robot that sways until it falls, or whose servos chatter, seems to have late joints.
  const bool is_certain = best <= -10 && explained > 0.8 && total_ > 2 * least_steps;
  if (best < 0 && !is_certain) return;
  if (!(turns_per_metre > 0.0 && turns_per_metre * least_radius < 1.0)) return;
  findings.add(best > 0 ? "IMU" : "joints",
               fmt::format("{} {:.2f} s after {}: are values older than their stamps? Map the "
                           "time of measurement",
                           best > 0 ? "comes" : "come", step_ * std::abs(best),
                           best > 0 ? "the joints" : "the IMU"));
}

}  // namespace touchdown::logs
