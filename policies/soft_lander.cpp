#include "policies/soft_lander.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace touchdown::policies {

namespace {

constexpr double long_ago = 1e3;  // s

// What a servo's scales of one stand for (N·m/rad, N·m·s/rad), as Upkie's spine sets them.
constexpr double servo_kp = 20.0;
constexpr double servo_kd = 1.0;

constexpr double speed_low_pass = 0.02;   // s: of the ground's speed
constexpr double dead_time = 0.06;        // s: a shorter flight is taken for a false alarm …
constexpr double one_dead_time = 0.1;     // s: … and of one wheel alone for a bump …
constexpr double softening_time = 0.1;    // s: … from there on the legs soften …
constexpr double soft_time = 0.25;        // s: … stay soft after a landing …
constexpr double stiffening_time = 0.4;   // s: … and stiffen again
constexpr double load_ramp = 0.02;        // s: in which the soft knees take the weight
constexpr double soft_stiffness = 500.0;  // N/m: of one soft leg along its line
constexpr double soft_damping = 140.0;    // N·s/m
constexpr double gravity = 9.81;          // m/s²

/// A leg from its knee, bent forward by `knee` from straight.
struct LegLine {
  double lever;       ///< of a force along the line from hip to axle on the knee (m)
  double angle;       ///< of that line from the upper link, forward (rad)
  double angle_rate;  ///< and how it changes with the knee
};

LegLine line_of(const SideView& robot, double knee) {
  const double u = robot.upper_length;
  const double l = robot.lower_length;
  const double square = u * u + l * l + 2.0 * u * l * std::cos(knee);
  return {u * l * std::sin(knee) / std::sqrt(square),
          std::atan2(l * std::sin(knee), u + l * std::cos(knee)),
          (l * l + u * l * std::cos(knee)) / square};
}

}  // namespace

SoftLander::SoftLander(const WheelBalancerConfig& config, Course course, const SideView& robot,
                       WheelContact contact)
    : config_(config),
      course_(std::move(course)),
      robot_(robot),
      told_(std::move(contact)),
      standing_(long_ago),
      on_ground_(long_ago) {}

void SoftLander::reset(const models::Observation& observation) {
  *this = SoftLander(config_, std::move(course_), robot_, std::move(told_));
  course_.begin(observation, config_);
}

void SoftLander::update_ground_velocity(const models::Observation& observation) {
  const auto mean = [&](std::size_t joint) {
    return 0.5 * (robot_.forward[0] * observation.servo[joint].position +
                  robot_.forward[1] * observation.servo[3 + joint].position);
  };
  const Eigen::Vector2d centre = robot_.centre(mean(0), mean(1), observation.pitch);
  const double lean = std::atan2(centre.x(), centre.y());
  if (contact_[0] || contact_[1]) {
    const double gain = -std::expm1(-course_.period / speed_low_pass);
    held_velocity_ += gain * (course_.rolling_speed(observation) - held_velocity_);
  }
  if (!flies()) {
    const double position_error = course_.target_position - course_.position;
    integral_ =
        std::clamp(integral_ + course_.period * (config_.position_stiffness * position_error -
                                                 config_.pitch_stiffness * lean),
                   -config_.max_integral, config_.max_integral);
    ground_velocity_ =
        config_.pitch_damping * lean - config_.position_damping * position_error - integral_;
  } else {
    course_.target_position = course_.position;
    course_.target_velocity = held_velocity_;
    integral_ = -held_velocity_;
    ground_velocity_ = config_.pitch_damping * lean + held_velocity_;
  }
  ground_velocity_ = std::clamp(ground_velocity_, -config_.max_velocity, config_.max_velocity);
}

bool SoftLander::flies() const { return in_air_ > dead_time; }

void SoftLander::update_softness() {
  standing_ = flies() ? 0.0 : standing_ + course_.period;
  const double sinking = std::max(in_air_ - dead_time, one_in_air_ - one_dead_time);
  if (sinking > 0.0) {
    on_ground_ = 0.0;
    softness_ = std::max(softness_, std::min(sinking / softening_time, 1.0));
  } else {
    on_ground_ += course_.period;
    if (on_ground_ > soft_time) {
      softness_ = std::max(0.0, softness_ - course_.period / stiffening_time);
    }
  }
}

void SoftLander::command_leg(std::size_t side, const models::Observation& observation,
                             models::Action& action) const {
  const std::size_t hip = 3 * side;
  const std::size_t knee = hip + 1;
  const double forward = robot_.forward[side];
  const double stiff = 1.0 - softness_;
  const double asked = forward * course_.posture[knee];
  const double bend = forward * observation.servo[knee].position;
  const LegLine line = line_of(robot_, bend);
  const double square = line.lever * line.lever;
  const double load = !flies() ? softness_ * 0.5 * robot_.mass * gravity * line.lever *
                                     std::min(1.0, standing_ / load_ramp)
                               : 0.0;
  action.servo[knee] = {
      .feedforward_torque = -forward * load,
      .position = course_.posture[knee],
      .kp_scale = stiff * config_.leg_kp_scale + softness_ * soft_stiffness * square / servo_kp,
      .kd_scale = stiff * config_.leg_kd_scale + softness_ * soft_damping * square / servo_kd};
  // The hip turns against the leg's line, as far as the legs are soft: the leg folds along it.
  const double folded = stiff * asked + softness_ * bend;
  action.servo[hip] = {.position = course_.posture[hip] + forward * (line_of(robot_, asked).angle -
                                                                     line_of(robot_, folded).angle),
                       .velocity = -softness_ * line.angle_rate * observation.servo[knee].velocity,
                       .kp_scale = config_.leg_kp_scale,
                       .kd_scale = config_.leg_kd_scale};
}

models::Action SoftLander::act(const models::Observation& observation) {
  course_.follow(observation, config_);
  contact_ = told_(observation, ground_velocity_);
  in_air_ = contact_[0] || contact_[1] ? 0.0 : in_air_ + course_.period;
  one_in_air_ = contact_[0] && contact_[1] ? 0.0 : one_in_air_ + course_.period;
  update_ground_velocity(observation);
  update_softness();
  models::Action action;
  for (std::size_t side = 0; side < models::wheel_count; ++side) {
    command_leg(side, observation, action);
  }
  // Wheels that are both free say nothing about where the robot heads, and turn nothing.
  const double turn = !flies() ? course_.yaw_torque(observation, config_) : 0.0;
  command_wheels(ground_velocity_, {turn, turn}, course_.wheel_radius, config_, action);
  return action;
}

}  // namespace touchdown::policies
