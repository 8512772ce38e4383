#include "logs/plausibility/load.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "estimator/record.hpp"
#include "logs/plausibility/relations.hpp"

namespace touchdown::logs {

namespace {

/// Bias and friction of a bad servo (noise/profiles/harsh.yaml: 0.1 N·m).
constexpr double torque_error = 0.13;  // N·m
/// Of a force: errors of geometry and scale, and of its direction (rad).
constexpr double share_error = 0.1;
/// A robot other than the assumed one may be this many times as heavy.
constexpr double heaviest_other = 6.0;
/// Another sign, unit or order is the cause if it explains the forces this much better.
constexpr double explains = 0.4;

/// Left hip, left knee, right hip, right knee.
struct LegJoint {
  double position;
  double torque;
};
using Joints = std::array<LegJoint, 4>;

using Factors = std::array<double, 4>;
constexpr Factors unchanged = {1.0, 1.0, 1.0, 1.0};

/// A way in which joints may differ from what they are taken for: in their order, that of torques
/// alone or of whole joints, or by factors.
struct Cause {
  std::string text;
  std::array<std::size_t, 4> order = {0, 1, 2, 3};
  Factors torque = unchanged;
  Factors position = unchanged;
  bool of_joints = false;

  bool moves_legs() const { return of_joints || position != unchanged; }
};

/// The first one is none. Of those that explain a log as well, the first one is named.
std::vector<Cause> make_causes() {
  std::vector<Cause> causes = {
      {""},
      {"the torques have the other sign", {0, 1, 2, 3}, {-1.0, -1.0, -1.0, -1.0}},
      {"the torques of the left leg have the other sign", {0, 1, 2, 3}, {-1.0, -1.0, 1.0, 1.0}},
      {"the torques of the right leg have the other sign", {0, 1, 2, 3}, {1.0, 1.0, -1.0, -1.0}},
      {"the torques of hips and knees are exchanged", {1, 0, 3, 2}},
      {"the torques of the left hip and knee are exchanged", {1, 0, 2, 3}},
      {"the torques of the right hip and knee are exchanged", {0, 1, 3, 2}},
      {"hips and knees are exchanged", {1, 0, 3, 2}, unchanged, unchanged, true},
      // A leg that is mirrored as a whole carries alike.
      {"hips or knees count the other way, or are exchanged between the sides",
       {0, 1, 2, 3},
       {-1, 1, -1, 1},
       {-1, 1, -1, 1}},
      {"left_hip or left_knee counts the other way", {0, 1, 2, 3}, {-1, 1, 1, 1}, {-1, 1, 1, 1}},
      {"right_hip or right_knee counts the other way", {0, 1, 2, 3}, {1, 1, -1, 1}, {1, 1, -1, 1}},
      {"positions are in revolutions", {0, 1, 2, 3}, unchanged, {6.2832, 6.2832, 6.2832, 6.2832}}};
  // Legs mirror each other: what is of the other side has the other sign.
  const std::array<std::pair<const char*, Factors>, 6> signs = {
      {{"s of the knees have the other sign, or are those of the other side", {1, -1, 1, -1}},
       {"s of the hips have the other sign, or are those of the other side", {-1, 1, -1, 1}},
       {" of left_knee has the other sign", {1, -1, 1, 1}},
       {" of right_knee has the other sign", {1, 1, 1, -1}},
       {" of left_hip has the other sign", {-1, 1, 1, 1}},
       {" of right_hip has the other sign", {1, 1, -1, 1}}}};
  for (const auto& [text, sign] : signs) {
    causes.push_back({fmt::format("the torque{}", text), causes[0].order, sign});
    causes.push_back({fmt::format("the position{}", text), causes[0].order, unchanged, sign});
  }
  return causes;
}

const std::vector<Cause>& all_causes() {
  static const std::vector<Cause> causes = make_causes();
  return causes;
}

/// The joints as they would be.
Joints undone(const Cause& cause, const Joints& joints) {
  Joints undone = joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const LegJoint& from = joints.at(cause.order.at(i));
    undone[i].torque = cause.torque[i] * from.torque;
    undone[i].position = cause.position[i] * (cause.of_joints ? from : joints[i]).position;
  }
  return undone;
}

/// Whether joints can be there: they turn by less than half a turn.
bool is_possible(const Joints& joints) {
  constexpr double most = 2.6;  // rad
  return std::ranges::all_of(joints, [](const LegJoint& j) { return std::abs(j.position) < most; });
}

Joints scaled(Joints joints, double factor) {
  for (LegJoint& joint : joints) joint.torque *= factor;
  return joints;
}

/// A leg in the torso's plane: its axle from the hip, and the force of the ground on it, along the
/// vertical and across it, with their errors (m, N).
struct LegForce {
  double axle_forward = 0.0;
  double axle_upward = 0.0;
  double vertical = 0.0;
  double forward = 0.0;
  double vertical_error = 0.0;
  double forward_error = 0.0;
};

/// `up`: the vertical in the leg's plane, forward and upward.
LegForce leg_force(const LegGeometry& geometry, const Joints& joints, std::size_t side,
                   const Eigen::Vector2d& up) {
  const LegJoint& hip = joints.at(2 * side);
  const LegJoint& knee = joints.at(2 * side + 1);
  const double sign = side == 1 ? -1.0 : 1.0;
  const LegSignals leg = {{hip.position}, {knee.position}, {}};
  const FootJacobian foot = foot_jacobian(geometry, leg, side == 1);
  // Jᵀ F = −τ + gravity's torques, of the masses on each link's end.
  const double on_axle = geometry.lower_centre * geometry.lower_mass + geometry.wheel_mass;
  const double on_knee =
      geometry.upper_centre * geometry.upper_mass + geometry.lower_mass + geometry.wheel_mass;
  const double upper = foot.upper_x * up.x() + foot.upper_z * up.y();
  const double lower = foot.lower_x * up.x() + foot.lower_z * up.y();
  const double of_knee = -sign * knee.torque + on_axle * lower * gravity_at_rest;
  const double of_hip = -sign * hip.torque + (on_knee * upper + on_axle * lower) * gravity_at_rest;
  // The links' moments alone: upper · F = of_hip − of_knee, lower · F = of_knee.
  const double of_upper = of_hip - of_knee;
  const double determinant = foot.determinant();
  const Eigen::Vector2d force((of_upper * foot.lower_z - of_knee * foot.upper_z) / determinant,
                              (foot.upper_x * of_knee - foot.lower_x * of_upper) / determinant);
  LegForce result;
  result.axle_forward = foot.upper_z + foot.lower_z;
  result.axle_upward = -foot.upper_x - foot.lower_x;
  result.vertical = force.dot(up);
  result.forward = force.x() * up.y() - force.y() * up.x();
  const double arms = std::abs(foot.upper_x + foot.lower_x) + std::abs(foot.lower_x);
  result.vertical_error = torque_error * arms / std::abs(determinant);
  const double across = std::abs(foot.upper_z + foot.lower_z) + std::abs(foot.lower_z);
  result.forward_error = torque_error * across / std::abs(determinant);
  return result;
}

/// How far the forces are from those of a robot at rest, by their errors, and both legs' load (N).
struct Misfit {
  double size = 0.0;
  double load = 0.0;
  double error = 0.0;   ///< of the load (N)
  double offset = 0.0;  ///< of both axles' middle, in front of the hips (m)
  double apart = 0.0;   ///< the left axle before the right one, in the torso (m)
};

Misfit misfit_of(const LegGeometry& geometry, const Joints& joints, const Eigen::Vector2d& up,
                 double heaviest) {
  Misfit misfit;
  double squares = 0.0;
  const double weight = gravity_at_rest * geometry.robot_mass;
  const auto outside = [&](double force) {
    return std::max({0.0, -force, force - heaviest * weight});
  };
  for (const std::size_t side : {0U, 1U}) {
    const LegForce force = leg_force(geometry, joints, side, up);
    const double error = share_error * weight + force.vertical_error;
    squares += std::pow(outside(force.vertical) / error, 2);
    squares += std::pow(
        force.forward / (share_error * std::abs(force.vertical) + force.forward_error + 1.0), 2);
    misfit.load += force.vertical;
    misfit.error = std::max(misfit.error, force.vertical_error);
    misfit.offset += 0.5 * (up.y() * force.axle_forward - up.x() * force.axle_upward);
    misfit.apart += (side == 0 ? 1.0 : -1.0) * force.axle_forward;
  }
  const double error = share_error * weight + misfit.error;
  misfit.size = std::sqrt(squares + std::pow(outside(misfit.load) / error, 2));
  return misfit;
}

}  // namespace

void LoadRelation::add(const CheckedWindow& window) {
  double largest = 0.0;
  for (std::size_t i = 0; i < window.joint.size(); ++i) {
    if (i % 3 != 2) largest = std::max(largest, std::abs(window.joint[i].torque));
  }
  if (!std::isfinite(largest)) return;
  ++windows_;
  largest_torque_ = std::max(largest_torque_, largest);
}

void LoadRelation::add_still(const CheckedWindow& stretch) {
  Joints joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const CheckedWindow::Joint& joint = stretch.joint[i + i / 2];
    joints[i] = {joint.position, joint.torque};
  }
  // The IMU's x axis points back, its z axis down.
  Eigen::Vector2d up(-stretch.up.x(), -stretch.up.z());
  if (!(up.norm() > 0.5)) return;
  up.normalize();
  const double heaviest = is_known_ ? 1.5 : heaviest_other;
  const double weight = gravity_at_rest * geometry_.robot_mass;
  const double length = geometry_.upper_length + geometry_.lower_length;
  std::vector<Misfit> misfit;
  for (const Cause& cause : all_causes()) {
    const Joints meant = undone(cause, joints);
    misfit.push_back(misfit_of(geometry_, meant, up, heaviest));
    if (misfit.size() == 1) continue;
    // A robot that stands has its wheels beside each other, and below its torso, whose centre of
    // mass is near the hips.
    constexpr double apart_error = 0.06;   // of a leg's length
    constexpr double offset_error = 0.15;  // likewise
    double& size = misfit.back().size;
    size = std::hypot(size, misfit.back().apart / (apart_error * length));
    if (!cause.moves_legs()) continue;
    constexpr double impossible = 1e3;
    size = is_possible(meant) ? std::hypot(size, misfit.back().offset / (offset_error * length))
                              : impossible;
  }
  if (!std::isfinite(misfit[0].size)) return;
  // Straight legs carry the weight without torques.
  if (share_error * weight + misfit[0].error > weight) return;
  ++stretches_;
  misfit_.resize(misfit.size());
  load_.resize(misfit.size());
  for (std::size_t i = 0; i < misfit.size(); ++i) {
    misfit_.at(i) += misfit.at(i).size;
    load_.at(i) += misfit.at(i).load;
  }
  largest_load_ = std::max(largest_load_, misfit[0].load);
  const double own = misfit_of(geometry_, scaled(joints, 0.0), up, heaviest).load;
  const double error = std::max(misfit[0].error, 1.0);
  carried_ += (misfit[0].load - own) / (error * error);
  to_carry_ += (weight - own) / (error * error);
  own_ += own / (error * error);
  largest_factor_ = std::max(largest_factor_, (misfit[0].load - own) / (weight - own));
  const bool carries = misfit[0].load > own && weight > own;
  const double factor = carries ? (weight - own) / (misfit[0].load - own) : 1.0;
  scaled_misfit_ += misfit_of(geometry_, scaled(joints, factor), up, heaviest).size;
  if (misfit[0].load < 0.5 * weight) return;
  ++standing_stretches_;
  axle_offset_ += misfit[0].offset;
  const double apart = misfit[0].apart;
  apart_ += apart;
  wrong_load_ += std::abs(misfit[0].load - weight);
  for (std::size_t i = 0; i < zeros; ++i) {
    // A joint's position moves its axle by the links below it.
    const FootJacobian foot = foot_jacobian(
        geometry_, {{joints.at(i / 2 * 2).position}, {joints.at(i / 2 * 2 + 1).position}, {}},
        i >= 2);
    const double lever = foot.lower_x + (i % 2 == 0 ? foot.upper_x : 0.0);
    const double shift = apart / lever * (i < 2 ? -1.0 : 1.0) * (i >= 2 ? -1.0 : 1.0);
    Joints moved = joints;
    moved.at(i).position += shift;
    shift_.at(i) += shift;
    shifted_load_.at(i) += std::abs(misfit_of(geometry_, moved, up, heaviest).load - weight);
  }
}

void LoadRelation::report(Findings& findings, bool drives) const {
  report_small_torques(findings);
  if (stretches_ == 0 || report_zero(findings) || report_pose(findings)) return;
  const double load = load_[0] / stretches_;
  const double weight = gravity_at_rest * geometry_.robot_mass;
  const double factor = carried_ / to_carry_;
  const auto add = [&](const std::string& finding) {
    findings.add("load of both legs while the robot is still", finding);
  };
  constexpr double largest_misfit = 1.3;
  constexpr double largest_factor = 1.6;  // uncalibrated torques have 1.3 (harsh.yaml)
  const bool is_too_large =
      is_known_ ? factor > largest_factor : factor > 2.0 * largest_factor && explains_weight();
  if (misfit_[0] > largest_misfit * stretches_ || is_too_large) {
    const bool is_possible = load >= 0.0 && load <= 1.2 * weight;
    add(fmt::format(
        "{} N, expected {} N{}{}: {}", fixed(load, 0),
        is_possible ? fmt::format("{:.0f}", weight) : fmt::format("0 to {:.0f}", weight),
        weight_text(), is_possible ? " or none, and straight up" : "",
        cause(drives || is_too_large)));
    return;
  }
  constexpr int few = 3;
  if (stretches_ < few || largest_factor_ >= (is_known_ ? 0.65 : 0.3)) return;
  // Legs that hang carry nothing but themselves.
  const double hanging = -own_ / to_carry_;
  const bool hangs = std::abs(factor - hanging) < 0.25 + 0.5 * std::abs(hanging);
  if (!drives && (hangs || !is_known_)) return;
  const std::string other =
      is_known_ && factor > 0.3
          ? fmt::format(", or --robot is {:.1f} times as heavy as this robot", 1.0 / factor)
          : "";
  add(fmt::format("at most {:.0f} N although {}, expected {:.0f} N{}: {}{}", largest_load_,
                  drives ? "the wheels drive it" : "it does not hang", weight, weight_text(),
                  cause(true), other));
}

/// Whether another order, sign or unit gives the weight: for a robot of unknown weight.
bool LoadRelation::explains_weight() const {
  const double weight = gravity_at_rest * geometry_.robot_mass;
  for (std::size_t i = 1; i < misfit_.size(); ++i) {
    const bool has_weight = std::abs(load_.at(i) / stretches_ - weight) < 0.15 * weight;
    if (has_weight && misfit_.at(i) < 0.6 * stretches_) return true;
  }
  return false;
}

std::string LoadRelation::weight_text() const {
  return is_known_ ? "" : " (Upkie's weight; --robot names another)";
}

/// The cause that explains the forces best; 0 for none. `carries`: the legs carry the robot.
/// `moved`: only those by which the legs are in another pose.
std::size_t LoadRelation::best_cause(bool carries, bool moved) const {
  const double weight = gravity_at_rest * geometry_.robot_mass;
  std::size_t best = 0;
  double least = moved ? stretches_ : std::max(1.0 * stretches_, explains * misfit_[0]);
  for (std::size_t i = 1; i < misfit_.size(); ++i) {
    const bool has_load = !carries || std::abs(load_.at(i) / stretches_ - weight) < 0.3 * weight;
    if (!has_load || misfit_.at(i) >= least) continue;
    if (moved && !all_causes().at(i).moves_legs()) continue;
    // The first one that explains the forces as well as they can be known, else the best one.
    least = std::min(misfit_.at(i), 0.5 * least);
    best = i;
  }
  return best;
}

std::string LoadRelation::cause(bool carries) const {
  const std::size_t best = best_cause(carries, false);
  // A cause that is only better than the log as it is comes after a factor that explains all.
  const bool is_explained = best > 0 && misfit_.at(best) < stretches_;
  const bool has_scale = carried_ > 0.0 && to_carry_ > 0.0;
  const bool scale_explains = has_scale && scaled_misfit_ < stretches_;
  if (scale_explains && !is_explained) return scale_text();
  if (best > 0) {
    return fmt::format("probably {}{}", all_causes().at(best).text,
                       scale_explains ? fmt::format("; or {}", scale_text()) : "");
  }
  if (has_scale && scaled_misfit_ < explains * misfit_[0]) return scale_text();
  return fmt::format("check signs, units, gear ratios and the order of joints{}",
                     is_known_ ? ", or whether the legs are those of --robot" : "");
}

std::string LoadRelation::scale_text() const {
  const double factor = carried_ / to_carry_;
  constexpr double error = 0.25;  // another robot's mass is another factor
  const std::string unit = cause_of("torque", factor, error, "");
  return fmt::format(
      "the torques are {} times those that carry its weight: are they {}in mA, in percent of a "
      "rating, or {}? `scale: {}` would carry it; or are the legs other ones{}",
      readable(factor, 2), unit.empty() ? "" : fmt::format("in {}, ", unit),
      factor > 1.0 ? "in another unit" : "those of motors before their gears",
      readable(1.0 / factor, 2), is_known_ ? " than those of --robot" : " (--robot)");
}

bool LoadRelation::report_zero(Findings& findings) const {
  constexpr int few = 3;
  if (standing_stretches_ < few) return false;
  constexpr double least_share = 0.12;  // of a leg's length: zeros err by 0.03 rad (harsh.yaml)
  const double apart = apart_ / standing_stretches_;
  if (std::abs(apart) < least_share * (geometry_.upper_length + geometry_.lower_length)) {
    return false;
  }
  const auto best = static_cast<std::size_t>(
      std::min_element(shifted_load_.begin(), shifted_load_.end()) - shifted_load_.begin());
  constexpr std::array<const char*, zeros> names = {"left_hip", "left_knee", "right_hip",
                                                    "right_knee"};
  constexpr double largest_zero = 0.5;  // rad: joints are zeroed by hand
  const double zero = -shift_.at(best) / standing_stretches_;
  const std::string sign = all_causes().at(best_cause(true, true)).text;
  const bool is_zero = std::abs(zero) <= largest_zero;
  const bool is_sign = !sign.empty() && !is_zero;
  findings.add(
      is_zero ? names.at(best) : "wheels",
      fmt::format("the left wheel is {:.2f} m {} the right one while the robot stands: {}",
                  std::abs(apart), apart > 0.0 ? "in front of" : "behind",
                  is_sign   ? fmt::format("probably {}", sign)
                  : is_zero ? fmt::format("is the zero of this joint off by {:.2f} rad{}{}", zero,
                                          sign.empty() ? "" : ", or: ", sign)
                            : "does a hip or knee count the other way, or is its zero off"));
  return true;
}

bool LoadRelation::report_pose(Findings& findings) const {
  if (standing_stretches_ == 0) return false;
  const double offset = axle_offset_ / standing_stretches_;
  // A torso's centre of mass is within a few centimetres of the hips.
  const double most = 0.35 * (geometry_.upper_length + geometry_.lower_length);
  if (std::abs(offset) <= most) return false;
  const std::string cause = all_causes().at(best_cause(true, true)).text;
  findings.add("wheels",
               fmt::format("are {:.2f} m {} the hips while the robot stands still: {}",
                           std::abs(offset), offset < 0.0 ? "behind" : "in front of",
                           cause.empty() ? "are hips and knees exchanged, or is a sign or zero of "
                                           "positions wrong"
                                         : fmt::format("probably {}", cause)));
  return !cause.empty();
}

void LoadRelation::report_small_torques(Findings& findings) const {
  // A hanging robot's hips and knees still hold their legs: a tenth of a N·m for Upkie.
  const double least = 4e-4 * gravity_at_rest * geometry_.robot_mass;
  constexpr int second = 10;  // windows
  if (windows_ < second || largest_torque_ == 0.0 || largest_torque_ >= least) return;
  findings.add(
      "torques of hips and knees",
      fmt::format("never exceed {:.2g} N·m: were torques in N·m mapped as mNm", largest_torque_));
}

}  // namespace touchdown::logs
