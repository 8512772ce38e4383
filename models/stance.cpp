#include "models/stance.hpp"

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

Stance usual_stance(const RobotModel& robot) {
  const Stance crouch;
  const Stance mirrored = {-crouch.hip, -crouch.knee};
  if (!stance_error(robot, crouch)) return crouch;
  if (!stance_error(robot, mirrored)) return mirrored;
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
    // In the signs of a stance, hip forward and knee backward.
    const double sign = (i < 3) == is_hip ? 1.0 : -1.0;
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
  return std::nullopt;
}

}  // namespace touchdown::models
