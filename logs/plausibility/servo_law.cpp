#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "logs/plausibility/rules.hpp"

namespace touchdown::logs {

namespace {

/// Errors of positions, which the servo's own encoder does not have (noise/profiles/harsh.yaml).
constexpr double position_error = 0.1;    // rad
constexpr double law_torque_error = 0.3;  // N·m
constexpr double law_share_error = 0.5;   // of the measured torque
constexpr int least_law_windows = 10;
/// Of two torques of the same size and different noise.
constexpr double largest_law_ratio = 2.5;
constexpr double least_law_motion = 0.1;  // N·m, standard deviation
constexpr double law_follows = 0.9;       // correlation

constexpr std::array<const char*, 4> law_causes = {
    "check signs, units and gains of the targets, and the order of joints",
    "they probably have the other sign", "they are probably those of the other leg",
    "they are probably in degrees"};

}  // namespace

void ServoLawCheck::add(const CheckedWindow& window) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const CheckedWindow::Joint& joint = window.joint[i];
    // The law of a wheel has no position, and estimators do not use it.
    if (i % 3 == 2 || !(joint.kp > 0.0) || !std::isfinite(joint.law[0] + joint.torque)) continue;
    Joint& sums = joints_[i];
    ++sums.windows;
    const double most =
        law_torque_error + law_share_error * std::abs(joint.torque) + position_error * joint.kp;
    for (std::size_t k = 0; k < sums.apart.size(); ++k) {
      if (!(std::abs(joint.law[k] - joint.torque) <= most)) ++sums.apart[k];
    }
    const Eigen::Vector2d torques(joint.law[0], joint.torque);
    sums.sum += torques;
    sums.products += torques * torques.transpose();
  }
}

void ServoLawCheck::report(Findings& findings) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Joint& joint = joints_[i];
    if (joint.windows < least_law_windows) continue;
    const std::string subject = fmt::format("targets of {}", models::servo_names[i]);
    if (2 * joint.apart[0] > joint.windows) {
      const auto* best = std::min_element(joint.apart.begin() + 1, joint.apart.end());
      const bool explains = 4 * *best < joint.windows;
      findings.add(subject, fmt::format("do not give the measured torques by the servo's law: {}",
                                        law_causes.at(explains ? best - joint.apart.begin() : 0)));
      continue;
    }
    const double n = joint.windows;
    const Eigen::Matrix2d spread = joint.products / n - joint.sum / n * (joint.sum / n).transpose();
    const double law = std::sqrt(spread(0, 0));
    const double measured = std::sqrt(spread(1, 1));
    if (!(measured > least_law_motion && spread(0, 1) > law_follows * law * measured)) continue;
    const double ratio = law / measured;
    if (ratio <= largest_law_ratio && ratio >= 1.0 / largest_law_ratio) continue;
    findings.add(subject, fmt::format("give {:.2g} times the measured torques by the servo's law: "
                                      "check the unit and scale of the gains",
                                      ratio));
  }
}

}  // namespace touchdown::logs
