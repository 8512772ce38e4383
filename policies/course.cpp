#include "policies/course.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace touchdown::policies {

namespace {

/// Moves `value` towards `target` by at most `most`.
double slewed(double value, double target, double most) {
  return value + std::clamp(target - value, -most, most);
}

}  // namespace

void Course::begin(const models::Observation& observation, const WheelBalancerConfig& config) {
  *this = Course{std::move(scripts), wheel_radius, period};
  for (std::size_t i = 0; i < models::servo_count; ++i) posture[i] = observation.servo[i].position;
  last_distance = rolled_distance(observation);
  last_yaw = observation.yaw;
  heading = observation.yaw;
  if (config.keep_heading) target_yaw = observation.yaw;
}

double Course::rolled_distance(const models::Observation& observation) const {
  const double left = observation.servo[models::index(models::Servo::left_wheel)].position;
  const double right = observation.servo[models::index(models::Servo::right_wheel)].position;
  return 0.5 * wheel_radius * (left - right);
}

double Course::rolling_speed(const models::Observation& observation) const {
  const double left = observation.servo[models::index(models::Servo::left_wheel)].velocity;
  const double right = observation.servo[models::index(models::Servo::right_wheel)].velocity;
  return 0.5 * wheel_radius * (left - right);
}

static void update_odometry(const models::Observation& observation, Course& course) {
  course.heading += std::remainder(observation.yaw - course.last_yaw, 2.0 * std::numbers::pi);
  course.last_yaw = observation.yaw;
  const double distance = course.rolled_distance(observation);
  const double rolled = distance - course.last_distance;
  course.last_distance = distance;
  course.position += rolled;
  course.lateral += rolled * std::sin(course.heading - course.target_yaw);
}

static void follow_crouch(double time, Course& course) {
  const CrouchCommand* command = crouch_at(course.scripts->crouch, time);
  if (command == nullptr) return;
  double& left_hip = course.posture[models::index(models::Servo::left_hip)];
  const double hip = slewed(left_hip, command->hip, command->rate * course.period);
  const double change = hip - left_hip;
  left_hip = hip;
  course.posture[models::index(models::Servo::left_knee)] -= knee_per_hip * change;
  course.posture[models::index(models::Servo::right_hip)] -= change;
  course.posture[models::index(models::Servo::right_knee)] += knee_per_hip * change;
}

void Course::follow(const models::Observation& observation, const WheelBalancerConfig& config) {
  update_odometry(observation, *this);
  const VelocityCommand command = command_at(scripts->velocity, observation.time);
  target_velocity = slewed(target_velocity, command.velocity, config.max_acceleration * period);
  target_position += target_velocity * period;
  target_yaw += command.yaw_rate * period;
  follow_crouch(observation.time, *this);
  target_position = std::clamp(target_position, position - config.max_position_error,
                               position + config.max_position_error);
}

double Course::yaw_torque(const models::Observation& observation,
                          const WheelBalancerConfig& config) const {
  const double lateral_error =
      std::clamp(lateral, -config.max_lateral_error, config.max_lateral_error);
  return config.yaw_stiffness * (heading - target_yaw + config.lateral_stiffness * lateral_error) +
         config.yaw_damping * observation.yaw_rate;
}

void command_wheels(double ground_velocity, const std::array<double, models::wheel_count>& torque,
                    double wheel_radius, const WheelBalancerConfig& config,
                    models::Action& action) {
  const double wheel_velocity = ground_velocity / wheel_radius;
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    // The wheels mirror each other, so the same raw torque on both turns the robot to the right.
    const double forward = wheel == 0 ? 1.0 : -1.0;
    action.servo[models::index(models::wheel_servos[wheel])] = {
        .feedforward_torque = torque[wheel],
        .velocity = forward * wheel_velocity,
        .kp_scale = 0.0,
        .kd_scale = config.wheel_kd_scale};
  }
}

}  // namespace touchdown::policies
