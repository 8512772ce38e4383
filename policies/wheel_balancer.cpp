#include "policies/wheel_balancer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace touchdown::policies {

namespace {

/// `value` moved towards `target` by at most `most`.
double slewed(double value, double target, double most) {
  return value + std::clamp(target - value, -most, most);
}

}  // namespace

WheelBalancer::WheelBalancer(const WheelBalancerConfig& config, VelocityScript script,
                             double wheel_radius, double period, CrouchScript crouch)
    : config_(config),
      script_(std::move(script)),
      wheel_radius_(wheel_radius),
      period_(period),
      crouch_(std::move(crouch)) {}

void WheelBalancer::reset(const models::Observation& observation) {
  *this = WheelBalancer(config_, std::move(script_), wheel_radius_, period_, std::move(crouch_));
  for (std::size_t i = 0; i < models::servo_count; ++i) posture_[i] = observation.servo[i].position;
  last_distance_ = rolled_distance(observation);
  last_yaw_ = observation.yaw;
  heading_ = observation.yaw;
  if (config_.keep_heading) target_yaw_ = observation.yaw;
}

double WheelBalancer::rolled_distance(const models::Observation& observation) const {
  const double left = observation.servo[models::index(models::Servo::left_wheel)].position;
  const double right = observation.servo[models::index(models::Servo::right_wheel)].position;
  return 0.5 * wheel_radius_ * (left - right);
}

void WheelBalancer::update_odometry(const models::Observation& observation) {
  heading_ += std::remainder(observation.yaw - last_yaw_, 2.0 * std::numbers::pi);
  last_yaw_ = observation.yaw;
  const double distance = rolled_distance(observation);
  const double rolled = distance - last_distance_;
  last_distance_ = distance;
  position_ += rolled;
  lateral_ += rolled * std::sin(heading_ - target_yaw_);
}

void WheelBalancer::follow_script(double time) {
  const VelocityCommand command = command_at(script_, time);
  target_velocity_ = slewed(target_velocity_, command.velocity, config_.max_acceleration * period_);
  target_position_ += target_velocity_ * period_;
  target_yaw_ += command.yaw_rate * period_;
}

void WheelBalancer::follow_crouch(double time) {
  const CrouchCommand* command = crouch_at(crouch_, time);
  if (command == nullptr) return;
  double& left_hip = posture_[models::index(models::Servo::left_hip)];
  const double hip = slewed(left_hip, command->hip, command->rate * period_);
  const double bend = hip - left_hip;
  left_hip = hip;
  posture_[models::index(models::Servo::left_knee)] -= knee_per_hip * bend;
  posture_[models::index(models::Servo::right_hip)] -= bend;
  posture_[models::index(models::Servo::right_knee)] += knee_per_hip * bend;
}

bool WheelBalancer::in_the_air(const models::Observation& observation) {
  bool any_contact = false;
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    const models::ServoReading& servo =
        observation.servo[models::index(models::wheel_servos[wheel])];
    contact_[wheel].update(servo.torque, servo.velocity, period_);
    any_contact = any_contact || contact_[wheel].contact();
  }
  return !any_contact;
}

void WheelBalancer::update_ground_velocity(const models::Observation& observation) {
  const double pitch_error = -observation.pitch;
  target_position_ = std::clamp(target_position_, position_ - config_.max_position_error,
                                position_ + config_.max_position_error);
  if (in_the_air(observation)) {
    // Wheels that spin in the air say nothing about place, and little about pitch: leak what was
    // accumulated. The pitch still counts, so that a false alarm does not tip the robot over.
    const double leak = period_ / config_.air_decay_time;
    integral_ -= leak * integral_;
    target_position_ += leak * (position_ - target_position_);
  } else {
    integral_ += period_ * config_.position_stiffness * (target_position_ - position_);
  }
  integral_ = std::clamp(integral_ + period_ * config_.pitch_stiffness * pitch_error,
                         -config_.max_integral, config_.max_integral);
  const double position_error = target_position_ - position_;
  // No feedforward of the target velocity: the wheels must first roll back for the robot to lean
  // forward, and the position error does just that.
  ground_velocity_ = std::clamp(
      -config_.pitch_damping * pitch_error - config_.position_damping * position_error - integral_,
      -config_.max_velocity, config_.max_velocity);
}

double WheelBalancer::yaw_torque(const models::Observation& observation) const {
  const double lateral =
      std::clamp(lateral_, -config_.max_lateral_error, config_.max_lateral_error);
  return config_.yaw_stiffness * (heading_ - target_yaw_ + config_.lateral_stiffness * lateral) +
         config_.yaw_damping * observation.yaw_rate;
}

models::Action WheelBalancer::act(const models::Observation& observation) {
  update_odometry(observation);
  follow_script(observation.time);
  follow_crouch(observation.time);
  update_ground_velocity(observation);

  models::Action action;
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    action.servo[i].position = posture_[i];
    action.servo[i].kp_scale = config_.leg_kp_scale;
    action.servo[i].kd_scale = config_.leg_kd_scale;
  }
  const double wheel_velocity = ground_velocity_ / wheel_radius_;
  const double turn = yaw_torque(observation);
  for (const auto& [servo, forward] :
       {std::pair{models::Servo::left_wheel, 1.0}, std::pair{models::Servo::right_wheel, -1.0}}) {
    // The wheels mirror each other, so the same raw torque on both turns the robot to the right.
    action.servo[models::index(servo)] = {.feedforward_torque = turn,
                                          .velocity = forward * wheel_velocity,
                                          .kp_scale = 0.0,
                                          .kd_scale = config_.wheel_kd_scale};
  }
  return action;
}

}  // namespace touchdown::policies
