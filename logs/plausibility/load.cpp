#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "estimator/record.hpp"
#include "logs/plausibility/rules.hpp"

namespace touchdown::logs {

namespace {

/// Bias and friction of a bad servo (noise/profiles/harsh.yaml: 0.1 N·m).
constexpr double torque_error = 0.13;  // N·m
/// Of the robot's weight: errors of geometry and scale.
constexpr double share_error = 0.1;
/// A robot other than the assumed one may be this many times as heavy.
constexpr double heaviest_other = 6.0;
/// Another sign, unit or order is the cause if it explains the forces this much better.
constexpr double explains = 0.4;

using Leg = LegSignals;
using Legs = std::array<Leg, 2>;

/// A way in which the joints of a log may differ from what they are taken for.
struct Hypothesis {
  enum class Swap { none, torques, joints };
  const char* cause;
  std::array<double, 2> of_leg = {1.0, 1.0};  ///< factors of the torques, left and right
  double of_knees = 1.0;
  Swap swap = Swap::none;  ///< of hips and knees
};

constexpr std::array<Hypothesis, 9> all_hypotheses = {{
    {""},
    {"the torques have the other sign", {-1.0, -1.0}},
    {"the torques of the left leg have the other sign", {-1.0, 1.0}},
    {"the torques of the right leg have the other sign", {1.0, -1.0}},
    {"the torques of the knees have the other sign", {1.0, 1.0}, -1.0},
    {"the torques of hips and knees are swapped", {1.0, 1.0}, 1.0, Hypothesis::Swap::torques},
    {"hips and knees are swapped", {1.0, 1.0}, 1.0, Hypothesis::Swap::joints},
    // Units, from `first_unit` on.
    {"the torques are in cNm", {1e-2, 1e-2}},
    {"the torques are in mNm", {1e-3, 1e-3}},
}};

void scale(Leg& leg, double factor) {
  leg.hip.torque *= factor;
  leg.knee.torque *= factor;
}

/// The joints as they would be.
Legs undone(const Hypothesis& hypothesis, Legs legs) {
  for (std::size_t side = 0; side < legs.size(); ++side) {
    Leg& leg = legs.at(side);
    scale(leg, hypothesis.of_leg.at(side));
    leg.knee.torque *= hypothesis.of_knees;
    if (hypothesis.swap == Hypothesis::Swap::torques) std::swap(leg.hip.torque, leg.knee.torque);
    if (hypothesis.swap == Hypothesis::Swap::joints) std::swap(leg.hip, leg.knee);
  }
  return legs;
}

constexpr std::size_t first_unit = 7;

/// The force of the ground on a leg's foot in the leg's plane (N), and its error.
struct FootForce {
  double vertical = 0.0;
  double forward = 0.0;
  double error = 0.0;
};

FootForce foot_force(const LegGeometry& geometry, const Leg& leg, bool mirrored) {
  const FootJacobian foot = foot_jacobian(geometry, leg, mirrored);
  // Jᵀ F = −τ + gravity's torques, of the masses on each link's end.
  const double sign = mirrored ? -1.0 : 1.0;
  const double on_axle = geometry.lower_centre * geometry.lower_mass + geometry.wheel_mass;
  const double on_knee =
      geometry.upper_centre * geometry.upper_mass + geometry.lower_mass + geometry.wheel_mass;
  const double knee = -sign * leg.knee.torque + on_axle * foot.lower_z * gravity_at_rest;
  const double hip =
      -sign * leg.hip.torque + (on_knee * foot.upper_z + on_axle * foot.lower_z) * gravity_at_rest;
  const double vertical =
      ((foot.upper_x + foot.lower_x) * knee - foot.lower_x * hip) / foot.determinant();
  const double arms = std::abs(foot.upper_x + foot.lower_x) + std::abs(foot.lower_x);
  return {vertical, (knee - foot.lower_z * vertical) / foot.lower_x,
          torque_error * arms / std::abs(foot.determinant())};
}

/// How far the axle is in front of the hip (m), along the horizontal. `up` is in the IMU's frame: x
/// back, y left, z down.
double axle_offset(const LegGeometry& geometry, const Leg& leg, bool mirrored,
                   const Eigen::Vector3d& up) {
  const double sign = mirrored ? -1.0 : 1.0;
  const double upper = sign * leg.hip.position;
  const double lower = upper + sign * leg.knee.position;
  const double forward =
      geometry.upper_length * std::sin(upper) + geometry.lower_length * std::sin(lower);
  const double upward =
      -geometry.upper_length * std::cos(upper) - geometry.lower_length * std::cos(lower);
  return -up.z() * forward + up.x() * upward;
}

/// How far the forces are from those of a robot at rest (N).
struct Misfit {
  double distance = 0.0;
  double load = 0.0;
  double error = 0.0;
};

Misfit misfit_of(const LegGeometry& geometry, const Legs& legs, double heaviest) {
  Misfit misfit;
  double squares = 0.0;
  const auto outside = [&](double force) {
    return std::max({0.0, -force, force - heaviest * gravity_at_rest * geometry.robot_mass});
  };
  for (const std::size_t side : {0U, 1U}) {
    const FootForce force = foot_force(geometry, legs.at(side), side == 1);
    squares += std::pow(outside(force.vertical), 2) + std::pow(force.forward, 2);
    misfit.load += force.vertical;
    misfit.error = std::max(misfit.error, force.error);
  }
  misfit.distance = std::sqrt(squares + std::pow(outside(misfit.load), 2));
  return misfit;
}

}  // namespace

void LoadCheck::add(const CheckedWindow& window) {
  double largest = 0.0;
  for (std::size_t i = 0; i < window.joint.size(); ++i) {
    if (i % 3 != 2) largest = std::max(largest, std::abs(window.joint[i].torque));
  }
  if (!std::isfinite(largest)) return;
  ++windows_;
  largest_torque_ = std::max(largest_torque_, largest);
}

void LoadCheck::add_still(const CheckedWindow& stretch) {
  Legs legs;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto joint = [&](std::size_t i) {
      const CheckedWindow::Joint& one = stretch.joint[3 * side + i];
      return JointSignals{one.position, one.velocity, one.torque};
    };
    legs.at(side) = {joint(0), joint(1), joint(2)};
  }
  const double heaviest = is_known_ ? 1.5 : heaviest_other;
  std::array<Misfit, hypotheses> misfit;
  for (std::size_t i = 0; i < hypotheses; ++i) {
    misfit.at(i) = misfit_of(geometry_, undone(all_hypotheses.at(i), legs), heaviest);
    if (!std::isfinite(misfit.at(i).distance + misfit.at(i).error)) return;
  }
  const double weight = gravity_at_rest * geometry_.robot_mass;
  const double tolerance = share_error * weight + misfit[0].error;
  if (tolerance > weight) return;  // straight legs carry the weight without torques
  ++stretches_;
  if (misfit[0].load > 0.5 * weight) {
    ++standing_stretches_;
    axle_offset_ += 0.5 * (axle_offset(geometry_, legs[0], false, stretch.up) +
                           axle_offset(geometry_, legs[1], true, stretch.up));
  }
  tolerance_ += tolerance;
  largest_load_ = std::max(largest_load_, misfit[0].load);
  Legs limp = legs;
  for (Leg& leg : limp) scale(leg, 0.0);
  const double own = misfit_of(geometry_, limp, heaviest).load;
  const double error = std::max(misfit[0].error, 1.0);
  carried_ += (misfit[0].load - own) / (error * error);
  to_carry_ += (weight - own) / (error * error);
  if (misfit[0].load > own && weight > own) {
    for (Leg& leg : legs) scale(leg, (weight - own) / (misfit[0].load - own));
  }
  scaled_misfit_ += misfit_of(geometry_, legs, heaviest).distance;
  for (std::size_t i = 0; i < hypotheses; ++i) {
    misfit_.at(i) += misfit.at(i).distance;
    load_.at(i) += misfit.at(i).load;
  }
}

void LoadCheck::report(Findings& findings, bool drives) const {
  report_small_torques(findings);
  report_pose(findings);
  if (!report_misfit(findings)) report_small_load(findings, drives);
}

bool LoadCheck::report_misfit(Findings& findings) const {
  if (stretches_ == 0 || misfit_[0] <= tolerance_) return false;
  const double load = load_[0] / stretches_;
  const double weight = gravity_at_rest * geometry_.robot_mass;
  // Any force is small in another unit: it has to be about the weight.
  std::array<double, hypotheses> misfits = misfit_;
  for (std::size_t i = first_unit; i < hypotheses; ++i) {
    const double share = torque_factor() / (i == first_unit ? 1e2 : 1e3);
    const double widest = is_known_ ? 2.0 : heaviest_other;
    const bool carries = share > 1.0 / widest && share < widest;
    if (!carries) misfits.at(i) = misfit_[0];
  }
  // The first one that explains the forces as well as they can be known, else the best one.
  const auto* best = std::find_if(misfits.begin() + 1, misfits.end(),
                                  [&](double misfit) { return misfit <= tolerance_; });
  if (best == misfits.end()) best = std::min_element(misfits.begin(), misfits.end());
  const auto index = static_cast<std::size_t>(best - misfits.begin());
  std::string cause = "check signs, units, gear ratios and the order of joints";
  if (*best < explains * misfit_[0]) {
    cause = fmt::format("probably {}", all_hypotheses.at(index).cause);
  } else if (scaled_misfit_ < std::max(tolerance_, explains * misfit_[0]) && load > weight) {
    cause = scale_text();
  } else if (is_known_) {
    cause += ", or whether the legs are those of --robot";
  }
  findings.add("load of both legs while the robot is still",
               fmt::format("{:.0f} N, expected 0 to {:.0f} N{}, straight up: {}", load, weight,
                           is_known_ ? "" : " (Upkie's weight; --robot names another)", cause));
  return true;
}

/// The torques by those that would carry the robot.
double LoadCheck::torque_factor() const {
  return to_carry_ > 0.0 ? std::max(carried_ / to_carry_, 1e-4) : 1.0;
}

std::string LoadCheck::scale_text() const {
  const double factor = torque_factor();
  struct Known {
    double size;
    const char* unit;
  };
  constexpr std::array<Known, 5> known = {{{1000.0, "mN·m (N·mm)"},
                                           {141.6, "ozf·in"},
                                           {100.0, "cN·m"},
                                           {10.2, "kgf·cm"},
                                           {8.85, "lbf·in"}}};
  std::string units;
  constexpr double error = 0.25;  // another robot's mass is another factor
  for (const Known& one : known) {
    if (std::abs(std::log(factor / one.size)) > error || !is_known_) continue;
    units += fmt::format("in {}, ", one.unit);
  }
  return fmt::format(
      "the torques are {:.2g} times those that carry its weight: are they {}in mA, in percent of a "
      "rating, or {}? `scale: {:.2g}` would carry it; or are the legs other ones{}",
      factor, units, factor > 1.0 ? "in another unit" : "those of motors before their gears",
      1.0 / factor, is_known_ ? " than those of --robot" : " (--robot)");
}

void LoadCheck::report_small_load(Findings& findings, bool drives) const {
  constexpr int few = 3;
  const double weight = gravity_at_rest * geometry_.robot_mass;
  const double least = (is_known_ ? 0.6 : 0.4) * weight;
  if (stretches_ < few || largest_load_ >= least) return;
  // A cause with which the legs carry the robot.
  const auto carries = [&](double load) {
    return std::abs(load / stretches_ - weight) < 0.3 * weight;
  };
  // The legs of a robot that hangs carry nothing.
  const bool hangs = load_[0] <= tolerance_ + 0.05 * weight * stretches_;
  if (!drives && (hangs || !is_known_)) return;
  const auto* const found = std::find_if(load_.begin() + 1, load_.end(), carries);
  const std::string cause =
      found == load_.end()
          ? fmt::format("check units, gear ratios and the order of joints; {}", scale_text())
          : fmt::format("probably {}",
                        all_hypotheses.at(static_cast<std::size_t>(found - load_.begin())).cause);
  findings.add("load of both legs while the robot is still",
               fmt::format("at most {:.0f} N although {}, expected {:.0f} N{}: {}", largest_load_,
                           drives ? "the wheels drive it" : "it does not hang", weight,
                           is_known_ ? "" : " (Upkie's weight; --robot names another)", cause));
}

void LoadCheck::report_pose(Findings& findings) const {
  if (standing_stretches_ == 0) return;
  const double offset = axle_offset_ / standing_stretches_;
  // A torso's centre of mass is within a few centimetres of the hips.
  const double most = 0.35 * (geometry_.upper_length + geometry_.lower_length);
  if (std::abs(offset) <= most) return;
  findings.add("wheels",
               fmt::format("are {:.2f} m {} the hips while the robot stands still: are hips "
                           "and knees swapped, or is a sign or zero of positions wrong",
                           std::abs(offset), offset < 0.0 ? "behind" : "in front of"));
}

void LoadCheck::report_small_torques(Findings& findings) const {
  // A hanging robot's hips and knees still hold their legs: a tenth of a N·m for Upkie.
  const double least = 4e-4 * gravity_at_rest * geometry_.robot_mass;
  constexpr int second = 10;  // windows
  if (windows_ < second || largest_torque_ == 0.0 || largest_torque_ >= least) return;
  findings.add(
      "torques of hips and knees",
      fmt::format("never exceed {:.2g} N·m: were torques in N·m mapped as mNm", largest_torque_));
}

}  // namespace touchdown::logs
