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
constexpr double law_explains = 0.25;     // of the variance

/// The knee of a hip, and the other way round.
std::size_t paired(std::size_t joint) { return joint % 3 == 0 ? joint + 1 : joint - 1; }

constexpr std::array<const char*, 4> law_causes = {
    "check signs, units and gains of the targets, and the order of joints",
    "they probably have the other sign", "they are probably those of the other leg",
    "they are probably in degrees"};

}  // namespace

void ServoLawCheck::add(const CheckedWindow& window) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const CheckedWindow::Joint& joint = window.joint[i];
    // The law of a wheel has no position, and estimators do not use it.
    if (i % 3 == 2 || !(joint.kp > 0.0)) continue;
    const Eigen::Vector3d torques(joint.law[0], joint.torque, window.joint.at(paired(i)).torque);
    if (!torques.allFinite()) continue;
    Joint& sums = joints_[i];
    ++sums.windows;
    const double most =
        law_torque_error + law_share_error * std::abs(joint.torque) + position_error * joint.kp;
    for (std::size_t k = 0; k < sums.apart.size(); ++k) {
      if (!(std::abs(joint.law[k] - joint.torque) <= most)) ++sums.apart[k];
    }
    sums.sum += torques;
    sums.products += torques * torques.transpose();
  }
}

Eigen::Matrix3d ServoLawCheck::Joint::spread() const {
  return products / windows - sum / windows * (sum / windows).transpose();
}

void ServoLawCheck::report(Findings& findings) const {
  // Constant errors of positions do not matter here.
  const auto fits_the_other = [](const Joint& joint) {
    const Eigen::Matrix3d spread = joint.spread();
    const auto error = [&](int i) { return spread(0, 0) - 2.0 * spread(0, i) + spread(i, i); };
    return error(1) > least_law_motion * least_law_motion && error(2) < law_explains * error(1);
  };
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Joint& joint = joints_[i];
    if (joint.windows < least_law_windows) continue;
    const std::string subject = fmt::format("targets of {}", models::servo_names[i]);
    if (2 * joint.apart[0] > joint.windows) {
      std::size_t best = 1;
      for (std::size_t k = 2; k < joint.apart.size(); ++k) {
        if (joint.apart[k] < joint.apart[best]) best = k;
      }
      const bool explains = 4 * joint.apart[best] < joint.windows;
      findings.add(subject, fmt::format("do not give the measured torques by the servo's law: {}",
                                        law_causes.at(explains ? best : 0)));
      continue;
    }
    const Eigen::Matrix3d spread = joint.spread();
    if (fits_the_other(joint) && fits_the_other(joints_.at(paired(i)))) {
      findings.add(subject,
                   "give the torque of the knee at the hip by the servo's law, and the "
                   "other way round: the torques of hips and knees are probably swapped");
      continue;
    }
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
