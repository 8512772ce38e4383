#include "models/stance.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace touchdown::models {

namespace {

/// The zeros of the file's joints, as a stance from straight legs.
Stance zeros_of(const RobotModel& robot) {
  return {robot.zero[index(Servo::left_hip)], -robot.zero[index(Servo::left_knee)]};
}

/// The stance within the ranges of both legs that bends the knees most nearly as Upkie's crouch
/// does, either way, with the axle as nearly as possible below the first joint.
std::optional<Stance> stance_within_ranges(const RobotModel& robot) {
  const MjDataPtr data = at_zero(robot);
  const auto at = [&](Servo servo) { return vector_at(data->xanchor, robot.joint[index(servo)]); };
  const bool has_hips = robot.has(index(Servo::left_hip));
  const double lower = (at(Servo::left_wheel) - at(Servo::left_knee)).norm();
  const double upper = has_hips ? (at(Servo::left_knee) - at(Servo::left_hip)).norm() : 0.0;
  std::optional<Stance> best;
  double least = std::numeric_limits<double>::infinity();
  constexpr double step = 0.02;  // rad
  constexpr int half_turn = 157;
  for (int k = -half_turn; k <= half_turn; ++k) {
    const double knee = step * k;
    for (int h = has_hips ? -half_turn : 0; h <= (has_hips ? half_turn : 0); ++h) {
      const Stance stance{step * h, knee};
      const double off = upper * std::sin(stance.hip) + lower * std::sin(stance.hip - knee);
      const double height = upper * std::cos(stance.hip) + lower * std::cos(stance.hip - knee);
      const double bend = std::abs(std::abs(knee) - Stance().knee);
      const double cost = std::abs(off) / (upper + lower) + bend;
      constexpr double within = 0.05;  // rad: room to move
      if (height <= 0.0 || cost >= least ||
          stance_error(robot, {stance.hip - within, knee - within}) ||
          stance_error(robot, {stance.hip + within, knee + within})) {
        continue;
      }
      least = cost;
      best = stance;
    }
  }
  return best;
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
  if (const auto found = stance_within_ranges(robot)) return *found;
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
