#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "policies/policy.hpp"

namespace touchdown::policies {

namespace {

/// Balances a wheeled biped while it follows a velocity script. It is Upkie's PI law on pitch and
/// position, plus feedback of the heading. The legs are stiff, in the posture of the reset or of a
/// crouch script. The position comes from wheel odometry. Contact comes from Upkie's wheel contact
/// observer, unless another contact source is given.
class WheelBalancer : public Policy {
 public:
  explicit WheelBalancer(PolicyParts parts)
      : parts_(std::move(parts)),
        contact_source_(parts_.contact ? parts_.contact : upkie_contact(parts_.course.period)) {}

  void reset(const models::Observation& observation) override;
  models::Action act(const models::Observation& observation) override;

 private:
  bool in_the_air(const models::Observation& observation);
  void update_ground_velocity(const models::Observation& observation);

  PolicyParts parts_;
  WheelContact contact_source_;
  double lean_ = 0.0;  ///< pitch at which the robot balances (rad)
  double integral_ = 0.0;
  double ground_velocity_ = 0.0;            ///< that the last action commanded (m/s)
  std::optional<models::Action> previous_;  ///< the last action
};

void WheelBalancer::reset(const models::Observation& observation) {
  *this = WheelBalancer(std::move(parts_));
  parts_.course.begin(observation, parts_.gains);
  if (parts_.keep_lean) lean_ = observation.pitch;
}

bool WheelBalancer::in_the_air(const models::Observation& observation) {
  const auto in_contact = contact_source_(observation, previous_ ? &*previous_ : nullptr);
  return !in_contact[0] && !in_contact[1];
}

void WheelBalancer::update_ground_velocity(const models::Observation& observation) {
  const double pitch_error = -(observation.pitch - lean_);
  const double period = parts_.course.period;
  if (in_the_air(observation)) {
    // Wheels in the air cannot control the position, and hardly the pitch: the integral decays. The
    // pitch is still fed back, so that a false alarm does not tip the robot over.
    const double leak = period / parts_.gains.air_decay_time;
    integral_ -= leak * integral_;
    parts_.course.target_position +=
        leak * (parts_.course.position - parts_.course.target_position);
  } else {
    integral_ += period * parts_.gains.position_stiffness *
                 (parts_.course.target_position - parts_.course.position);
  }
  integral_ = std::clamp(integral_ + period * parts_.gains.pitch_stiffness * pitch_error,
                         -parts_.gains.max_integral, parts_.gains.max_integral);
  const double position_error = parts_.course.target_position - parts_.course.position;
  // No feedforward of the target velocity: the wheels must first roll back so that the robot leans
  // forward. The position error has this effect.
  ground_velocity_ = std::clamp(-parts_.gains.pitch_damping * pitch_error -
                                    parts_.gains.position_damping * position_error - integral_,
                                -parts_.gains.max_velocity, parts_.gains.max_velocity);
}

models::Action WheelBalancer::act(const models::Observation& observation) {
  parts_.course.follow(observation, parts_.gains);
  update_ground_velocity(observation);

  models::Action action;
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    action.servo[i].position = parts_.course.posture[i];
    action.servo[i].kp_scale = parts_.gains.leg_kp_scale;
    action.servo[i].kd_scale = parts_.gains.leg_kd_scale;
  }
  const double turn = parts_.course.yaw_torque(observation, parts_.gains);
  command_wheels(ground_velocity_, {turn, turn}, parts_.course.wheel_radius, parts_.gains, action);
  previous_ = action;
  return action;
}

}  // namespace

std::unique_ptr<Policy> make_wheel_balancer(PolicyParts parts) {
  return std::make_unique<WheelBalancer>(std::move(parts));
}

std::unique_ptr<Policy> make_policy(PolicyConfig::Law law, PolicyParts parts,
                                    const models::RobotModel& robot) {
  return law == PolicyConfig::Law::soft_landing ? make_soft_lander(std::move(parts), robot)
                                                : make_wheel_balancer(std::move(parts));
}

}  // namespace touchdown::policies
