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

/// The range of both hips, or of both knees, in the signs of a stance.
std::pair<double, double> common_range(const RobotModel& robot, bool is_hip) {
  std::pair<double, double> common = {-std::numbers::pi, std::numbers::pi};
  for (const std::size_t servo : {is_hip ? 0U : 1U, is_hip ? 3U : 4U}) {
    const int joint = robot.joint[servo];
    if (joint < 0 || robot.mj->jnt_limited[joint] == 0) continue;
    const double sign = stance_sign(servo);
    const mjtNum* const range = &robot.mj->jnt_range[2 * joint];
    common.first = std::max(common.first, std::min(sign * range[0], sign * range[1]));
    common.second = std::min(common.second, std::max(sign * range[0], sign * range[1]));
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
  if (const auto& leg = robot.closed_leg[0]) return {leg->linkage.start[0], -leg->linkage.start[1]};
  const Stance crouch;
  const Stance mirrored = {-crouch.hip, -crouch.knee};
  if (!stance_error(robot, crouch)) return crouch;
  if (!stance_error(robot, mirrored)) return mirrored;
  const Stance nearest = stance_within_ranges(robot);
  if (!stance_error(robot, nearest)) return nearest;
  const std::size_t hip = index(Servo::left_hip);
  return {robot.has(hip) ? robot.reference(hip) : 0.0, -robot.reference(hip + 1)};
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
    const mjtNum* const range = &robot.mj->jnt_range[2 * robot.joint[i]];
    double low = sign * range[0];
    double high = sign * range[1];
    if (low > high) std::swap(low, high);
    const auto shown = [&](double x) { return std::round(1e4 * (x - zero)) / 1e4 + 0.0; };
    return StanceError{
        is_hip ? "hip" : "knee",
        fmt::format("expected {:g} to {:g}, the range of joint '{}'{}, found {:g}", shown(low),
                    shown(high), robot.joint_name[i],
                    in_zeros_of_file ? "" : " from a straight leg", shown(sign * angle[i]))};
  }
  return loop_error(robot, angle);
}

}  // namespace touchdown::models
