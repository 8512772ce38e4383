#include "policies/wheel_balancer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace touchdown::policies {

WheelBalancer::WheelBalancer(const WheelBalancerConfig& config, Course course, WheelContact contact,
                             bool keep_lean)
    : config_(config),
      course_(std::move(course)),
      given_contact_source_(std::move(contact)),
      contact_source_(given_contact_source_ ? given_contact_source_
                                            : upkie_contact(course_.period)),
      keep_lean_(keep_lean) {}

void WheelBalancer::reset(const models::Observation& observation) {
  *this = WheelBalancer(config_, std::move(course_), std::move(given_contact_source_), keep_lean_);
  course_.begin(observation, config_);
  if (keep_lean_) lean_ = observation.pitch;
}

bool WheelBalancer::in_the_air(const models::Observation& observation) {
  const auto in_contact = contact_source_(observation, previous_ ? &*previous_ : nullptr);
  return !in_contact[0] && !in_contact[1];
}

void WheelBalancer::update_ground_velocity(const models::Observation& observation) {
  const double pitch_error = -(observation.pitch - lean_);
  const double period = course_.period;
  if (in_the_air(observation)) {
    // Wheels in the air cannot control the position, and hardly the pitch: the integral decays. The
    // pitch is still fed back, so that a false alarm does not tip the robot over.
    const double leak = period / config_.air_decay_time;
    integral_ -= leak * integral_;
    course_.target_position += leak * (course_.position - course_.target_position);
  } else {
    integral_ += period * config_.position_stiffness * (course_.target_position - course_.position);
  }
  integral_ = std::clamp(integral_ + period * config_.pitch_stiffness * pitch_error,
                         -config_.max_integral, config_.max_integral);
  const double position_error = course_.target_position - course_.position;
  // No feedforward of the target velocity: the wheels must first roll back so that the robot leans
  // forward. The position error has this effect.
  ground_velocity_ = std::clamp(
      -config_.pitch_damping * pitch_error - config_.position_damping * position_error - integral_,
      -config_.max_velocity, config_.max_velocity);
}

models::Action WheelBalancer::act(const models::Observation& observation) {
  course_.follow(observation, config_);
  update_ground_velocity(observation);

  models::Action action;
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    action.servo[i].position = course_.posture[i];
    action.servo[i].kp_scale = config_.leg_kp_scale;
    action.servo[i].kd_scale = config_.leg_kd_scale;
  }
  const double turn = course_.yaw_torque(observation, config_);
  command_wheels(ground_velocity_, {turn, turn}, course_.wheel_radius, config_, action);
  previous_ = action;
  return action;
}

}  // namespace touchdown::policies
