#include "models/stance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace touchdown::models {

namespace {

/// The zeros of the file's joints, as a stance from straight legs.
Stance zeros_of(const RobotModel& robot) {
  return {robot.zero[index(Servo::left_hip)], -robot.zero[index(Servo::left_knee)]};
}

/// The sign of a joint's angle in a stance: hips forward, knees backward.
double stance_sign(std::size_t servo) { return (servo < 3) == (servo % 3 == 0) ? 1.0 : -1.0; }

/// The range of a servo's joint, which has one, in the signs of a stance.
std::pair<double, double> range_of(const RobotModel& robot, std::size_t servo) {
  const mjtNum* const range = &robot.mj->jnt_range[2 * robot.joint[servo]];
  const double sign = stance_sign(servo);
  return std::minmax(sign * range[0] + 0.0, sign * range[1] + 0.0);  // no −0
}

/// The range of both hips, or of both knees, in the signs of a stance.
std::pair<double, double> common_range(const RobotModel& robot, bool is_hip) {
  std::pair<double, double> common = {-std::numbers::pi, std::numbers::pi};
  for (const std::size_t servo : {is_hip ? 0U : 1U, is_hip ? 3U : 4U}) {
    const int joint = robot.joint[servo];
    if (joint < 0 || robot.mj->jnt_limited[joint] == 0) continue;
    const auto [low, high] = range_of(robot, servo);
    common = {std::max(common.first, low), std::min(common.second, high)};
  }
  return common;
}

/// The angle within a range and with some room to move that is nearest to another.
double within(const std::pair<double, double>& range, double angle) {
  const double room = std::min(0.05, 0.5 * (range.second - range.first));  // rad
  return std::min(std::max(angle, range.first + room), range.second - room);
}

/// The stance within the ranges of both legs that bends the knees most nearly as Upkie's crouch
/// does, either way, with the axle as nearly as possible below the first joint. The joints may
/// have no such stance.
Stance stance_within_ranges(const RobotModel& robot) {
  const MjDataPtr data = at_zero(robot);
  const auto at = [&](Servo servo) { return vector_at(data->xanchor, robot.joint[index(servo)]); };
  const double bend = Stance().knee;
  const std::pair<double, double> knees = common_range(robot, false);
  const double backward = within(knees, bend);
  const double forward = within(knees, -bend);
  const double knee = std::abs(backward - bend) <= std::abs(forward + bend) ? backward : forward;
  if (!robot.has(index(Servo::left_hip))) return {0.0, knee};
  const double lower = (at(Servo::left_wheel) - at(Servo::left_knee)).norm();
  const double upper = (at(Servo::left_knee) - at(Servo::left_hip)).norm();
  const double above = std::atan2(lower * std::sin(knee), upper + lower * std::cos(knee));
  return {within(common_range(robot, true), above), knee};
}

/// The pose of closed legs nearest to that of the file, by their motors, whose hip and knee both
/// legs can have, with some room to move; that of the file if there is none. Of equally near ones,
/// it is that with the axle nearest to its place.
Stance closed_stance(const RobotModel& robot) {
  const Linkage& linkage = robot.closed_leg[0]->linkage;
  const std::array ranges = {common_range(robot, true), common_range(robot, false)};
  const auto axle = [&](const LinkageVector& q) {
    return LinkagePose(linkage, q).place(linkage.axle).x();
  };
  const auto stance_of = [](const LinkageVector& q) { return Stance{q[0], -q[1]}; };
  if (!stance_error(robot, stance_of(linkage.start))) return stance_of(linkage.start);
  constexpr double step = 0.05;  // rad
  constexpr int most = 30;
  for (int ring = 1; ring <= most; ++ring) {
    std::optional<Stance> nearest;
    double least = HUGE_VAL;
    const int other = linkage.motors.size() > 1 ? ring : 0;
    for (int i = -ring; i <= ring; ++i) {
      for (int k = -other; k <= other; ++k) {
        if (std::max(std::abs(i), std::abs(k)) != ring) continue;
        std::vector<double> at = {linkage.start[linkage.motors[0]] + i * step};
        if (other > 0) at.push_back(linkage.start[linkage.motors[1]] + k * step);
        LinkageVector q = linkage.start;
        if (!move_linkage(linkage, linkage.motors, at, q)) continue;
        const Stance stance = stance_of(q);
        const double off = std::abs(axle(q) - axle(linkage.start));
        if (off >= least || within(ranges[0], stance.hip) != stance.hip ||
            within(ranges[1], stance.knee) != stance.knee || stance_error(robot, stance)) {
          continue;
        }
        least = off;
        nearest = stance;
      }
    }
    if (nearest) return *nearest;
  }
  return stance_of(linkage.start);
}

/// The complaint about a stance in which the loops of a leg do not close, or its motors do not
/// determine the wheel.
std::optional<StanceError> loop_error(const RobotModel& robot,
                                      const std::array<double, servo_count>& angle) {
  for (std::size_t leg = 0; leg < wheel_count; ++leg) {
    if (!robot.closed_leg[leg]) continue;
    const Linkage& linkage = robot.closed_leg[leg]->linkage;
    const char* const side = leg == 0 ? "left" : "right";
    LinkageVector q = linkage.start;
    if (!move_virtual_leg(linkage, angle[3 * leg], angle[3 * leg + 1], q)) {
      return StanceError{"hip", fmt::format("the loops of the {} leg do not close there", side)};
    }
    if (!is_regular(linkage, q)) {
      return StanceError{"hip", fmt::format("the rods of the {} leg are in line there: its motors "
                                            "do not determine the wheel",
                                            side)};
    }
  }
  return std::nullopt;
}

}  // namespace

bool can_turn(const RobotModel& robot, std::size_t servo, double angle) {
  const int joint = robot.joint[servo];
  const mjtNum* range = &robot.mj->jnt_range[2 * joint];
  return robot.mj->jnt_limited[joint] == 0 || (range[0] <= angle && angle <= range[1]);
}

Stance from_straight(const RobotModel& robot, const Stance& stance) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const Stance zeros = zeros_of(robot);
  if (zeros.hip == 0.0 && zeros.knee == 0.0) return stance;
  return {std::remainder(stance.hip + zeros.hip, turn),
          std::remainder(stance.knee + zeros.knee, turn)};
}

Stance in_zeros_of_file(const RobotModel& robot, const Stance& stance) {
  const Stance zeros = zeros_of(robot);
  return from_straight(robot, {stance.hip - 2.0 * zeros.hip, stance.knee - 2.0 * zeros.knee});
}

Stance usual_stance(const RobotModel& robot) {
  if (robot.closed_leg[0]) return closed_stance(robot);
  const Stance crouch;
  const Stance mirrored = {-crouch.hip, -crouch.knee};
  if (!stance_error(robot, crouch)) return crouch;
  if (!stance_error(robot, mirrored)) return mirrored;
  const Stance nearest = stance_within_ranges(robot);
  if (!stance_error(robot, nearest)) return nearest;
  const std::size_t hip = index(Servo::left_hip);
  return {robot.has(hip) ? robot.reference(hip) : 0.0, -robot.reference(hip + 1)};
}

std::vector<std::string> range_complaints(const RobotModel& robot) {
  constexpr double narrow = 0.11;  // rad: a turn, 6.28, in degrees
  std::vector<std::string> complaints;
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (i % 3 == 2 || !robot.has(i) || robot.mj->jnt_limited[robot.joint[i]] == 0) continue;
    const auto [low, high] = range_of(robot, i);
    if (high - low >= narrow) continue;
    complaints.push_back(fmt::format(
        "joint '{}': its range is {:.3g} rad wide, {:.2g}°: is it in radians where the file has "
        "degrees (<compiler angle=\"radian\"/>)?",
        robot.joint_name[i], high - low, (high - low) * 180.0 / std::numbers::pi));
  }
  for (const std::size_t left : {0U, 1U}) {
    const auto [low, high] = common_range(robot, left == 0);
    if (high - low >= narrow || !complaints.empty()) continue;
    complaints.push_back(fmt::format(
        "joints '{}' and '{}': no angle from a straight leg is within both ranges: the legs cannot "
        "bend alike: has one axis or range a wrong sign?",
        robot.joint_name[left], robot.joint_name[left + 3]));
  }
  return complaints;
}

std::string reason_to_fall(const RobotModel& robot, const mjData& file, const mjData& standing) {
  const auto reach = [&](const mjData& pose, std::size_t servo) -> Eigen::Vector3d {
    return vector_at(pose.xanchor, robot.joint[servo / 3 * 3 + 2]) -
           vector_at(pose.xanchor, robot.joint[servo]);
  };
  if (reach(file, robot.has(0) ? 0 : 1).z() > 0.0) {
    return "its wheels are above its legs in the pose of the file: does the base's z axis point "
           "down?";
  }
  const double mass = mj_getTotalmass(robot.mj.get());
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (i % 3 == 2 || !robot.has(i) || robot.closed_leg[i / 3]) continue;
    const double needed = 0.5 * 9.81 * mass * std::abs(reach(standing, i).x());
    if (robot.effort[i] >= needed) continue;
    return fmt::format(
        "to stand, joint '{}' needs {:.3g} N·m, and its torque limit is {:.3g} N·m: is the limit "
        "wrong, or the mass of {:.4g} kg?",
        robot.joint_name[i], needed, robot.effort[i], mass);
  }
  return {};
}

std::optional<StanceError> stance_error(const RobotModel& robot, const Stance& stance,
                                        bool in_zeros_of_file) {
  const std::array<double, servo_count> angle = {stance.hip,  -stance.knee, 0.0,
                                                 -stance.hip, stance.knee,  0.0};
  const Stance zeros = in_zeros_of_file ? zeros_of(robot) : Stance{0.0, 0.0};
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (i % 3 == 2 || !robot.has(i) || can_turn(robot, i, angle[i])) continue;
    const bool is_hip = i % 3 == 0;
    const double sign = stance_sign(i);
    const double zero = is_hip ? zeros.hip : zeros.knee;
    const std::pair<double, double> range = range_of(robot, i);
    const auto shown = [&](double x) { return std::round(1e4 * (x - zero)) / 1e4 + 0.0; };
    return StanceError{
        is_hip ? "hip" : "knee",
        fmt::format("expected {:g} to {:g}, the range of joint '{}'{}, found {:g}",
                    shown(range.first), shown(range.second), robot.joint_name[i],
                    in_zeros_of_file ? "" : " from a straight leg", shown(sign * angle[i]))};
  }
  return loop_error(robot, angle);
}

}  // namespace touchdown::models
