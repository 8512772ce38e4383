#include "policies/wheel_balancer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace touchdown {

namespace {

/// `value` moved towards `target` by at most `most`.
double slewed(double value, double target, double most) {
  return value + std::clamp(target - value, -most, most);
}

}  // namespace

WheelBalancer::WheelBalancer(const WheelBalancerConfig& config, VelocityScript script,
                             double wheel_radius, double period)
    : config_(config), script_(std::move(script)), wheel_radius_(wheel_radius), period_(period) {}

void WheelBalancer::reset(const Observation& observation) {
  *this = WheelBalancer(config_, std::move(script_), wheel_radius_, period_);
  for (std::size_t i = 0; i < servo_count; ++i) posture_[i] = observation.servo[i].position;
  last_distance_ = rolled_distance(observation);
  last_yaw_ = observation.yaw;
  heading_ = observation.yaw;
  if (config_.keep_heading) target_yaw_ = observation.yaw;
}

double WheelBalancer::rolled_distance(const Observation& observation) const {
  const double left = observation.servo[index(Servo::left_wheel)].position;
  const double right = observation.servo[index(Servo::right_wheel)].position;
  return 0.5 * wheel_radius_ * (left - right);
}

void WheelBalancer::update_odometry(const Observation& observation) {
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

bool WheelBalancer::in_the_air(const Observation& observation) {
  bool any_contact = false;
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    const ServoReading& servo = observation.servo[index(wheel_servos[wheel])];
    contact_[wheel].update(servo.torque, servo.velocity, period_);
    any_contact = any_contact || contact_[wheel].contact();
  }
  return !any_contact;
}

void WheelBalancer::update_ground_velocity(const Observation& observation) {
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

double WheelBalancer::yaw_torque(const Observation& observation) const {
  const double lateral =
      std::clamp(lateral_, -config_.max_lateral_error, config_.max_lateral_error);
  return config_.yaw_stiffness * (heading_ - target_yaw_ + config_.lateral_stiffness * lateral) +
         config_.yaw_damping * observation.yaw_rate;
}

Action WheelBalancer::act(const Observation& observation) {
  update_odometry(observation);
  follow_script(observation.time);
  update_ground_velocity(observation);

  Action action;
  for (std::size_t i = 0; i < servo_count; ++i) {
    action.servo[i].position = posture_[i];
    action.servo[i].kp_scale = config_.leg_kp_scale;
    action.servo[i].kd_scale = config_.leg_kd_scale;
  }
  const double wheel_velocity = ground_velocity_ / wheel_radius_;
  const double turn = yaw_torque(observation);
  for (const auto& [servo, forward] :
       {std::pair{Servo::left_wheel, 1.0}, std::pair{Servo::right_wheel, -1.0}}) {
    // The wheels mirror each other, so the same raw torque on both turns the robot to the right.
    action.servo[index(servo)] = {.feedforward_torque = turn,
                                  .velocity = forward * wheel_velocity,
                                  .kp_scale = 0.0,
                                  .kd_scale = config_.wheel_kd_scale};
  }
  return action;
}

WheelBalancerConfig wheel_balancer_from_yaml(YamlMap map) {
  WheelBalancerConfig c;
  map.read("pitch_stiffness", c.pitch_stiffness, 0.0, 1e4);
  map.read("pitch_damping", c.pitch_damping, 0.0, 1e4);
  map.read("position_stiffness", c.position_stiffness, 0.0, 1e4);
  map.read("position_damping", c.position_damping, 0.0, 1e4);
  map.read("max_velocity", c.max_velocity, 0.0, 100.0);
  map.read("max_integral", c.max_integral, 0.0, 1e3);
  map.read("max_acceleration", c.max_acceleration, 0.0, 100.0);
  map.read("max_position_error", c.max_position_error, 0.0, 100.0);
  map.read("air_decay_time", c.air_decay_time, 1e-3, 1e3);
  map.read("wheel_kd_scale", c.wheel_kd_scale, 0.0, 100.0);
  map.read("yaw_stiffness", c.yaw_stiffness, 0.0, 100.0);
  map.read("yaw_damping", c.yaw_damping, 0.0, 100.0);
  map.read("lateral_stiffness", c.lateral_stiffness, 0.0, 100.0);
  map.read("max_lateral_error", c.max_lateral_error, 0.0, 100.0);
  map.read("keep_heading", c.keep_heading);
  map.read("leg_kp_scale", c.leg_kp_scale, 0.0, 100.0);
  map.read("leg_kd_scale", c.leg_kd_scale, 0.0, 100.0);
  map.finish();
  return c;
}

YAML::Node to_yaml(const WheelBalancerConfig& c) {
  YAML::Node node;
  node["pitch_stiffness"] = c.pitch_stiffness;
  node["pitch_damping"] = c.pitch_damping;
  node["position_stiffness"] = c.position_stiffness;
  node["position_damping"] = c.position_damping;
  node["max_velocity"] = c.max_velocity;
  node["max_integral"] = c.max_integral;
  node["max_acceleration"] = c.max_acceleration;
  node["max_position_error"] = c.max_position_error;
  node["air_decay_time"] = c.air_decay_time;
  node["wheel_kd_scale"] = c.wheel_kd_scale;
  node["yaw_stiffness"] = c.yaw_stiffness;
  node["yaw_damping"] = c.yaw_damping;
  node["lateral_stiffness"] = c.lateral_stiffness;
  node["max_lateral_error"] = c.max_lateral_error;
  node["keep_heading"] = c.keep_heading;
  node["leg_kp_scale"] = c.leg_kp_scale;
  node["leg_kd_scale"] = c.leg_kd_scale;
  return node;
}

}  // namespace touchdown
