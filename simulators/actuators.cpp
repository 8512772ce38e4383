#include "simulators/actuators.hpp"

#include <algorithm>
#include <cmath>

#include "simulators/servo.hpp"

namespace touchdown::simulators {

Actuators::Actuators(const models::RobotModel& model, const StepSizes& steps)
    : ideal_(std::all_of(model.actuator.begin(), model.actuator.end(),
                         [](const models::Actuator& a) { return a.is_ideal(); })) {
  const double physics_period = 1e-6 * static_cast<double>(steps.physics_us);
  const double control_period = 1e-6 * static_cast<double>(steps.control_us);
  for (std::size_t i = 0; i < joint_.size(); ++i) {
    Joint& joint = joint_[i];
    joint.actuator = model.actuator[i];
    joint.effort = model.effort[i];  // zero without a joint
    if (!model.has(i)) continue;
    joint.friction = JointFriction(
        joint.actuator, 1.0 / model.mj->dof_invweight0[model.dof_address[i]], physics_period);
    if (joint.actuator.torque_lag > 0.0) {
      joint.lag_gain = -std::expm1(-physics_period / joint.actuator.torque_lag);
    }
    joint.delay =
        static_cast<std::size_t>(std::lround(joint.actuator.command_delay / control_period));
    longest_delay_ = std::max(longest_delay_, joint.delay);
  }
}

void Actuators::reset() {
  started_ = false;
  commands_.clear();
  for (Joint& joint : joint_) {
    joint.torque = 0.0;
    joint.friction.reset();
  }
}

const models::Action& Actuators::delayed(const models::Action& action) {
  if (longest_delay_ == 0) return action;
  if (commands_.empty()) commands_.assign(longest_delay_, action);
  commands_.push_back(action);
  for (std::size_t i = 0; i < joint_.size(); ++i) {
    executed_.servo[i] = commands_[commands_.size() - 1 - joint_[i].delay].servo[i];
  }
  commands_.pop_front();
  return executed_;
}

Actuators::Torques Actuators::step(const models::Action& action, const JointTorques& position,
                                   const JointTorques& velocity) {
  Torques torques;
  for (std::size_t i = 0; i < joint_.size(); ++i) {
    torques.reported[i] = servo_torque(action.servo[i], position[i], velocity[i], joint_[i].effort);
  }
  if (ideal_) {
    torques.applied = torques.reported;
    return torques;
  }
  for (std::size_t i = 0; i < joint_.size(); ++i) {
    Joint& joint = joint_[i];
    if (!started_) joint.friction.start_at(position[i]);
    joint.torque += joint.lag_gain * (torques.reported[i] - joint.torque);
    const models::Actuator& a = joint.actuator;
    torques.reported[i] = joint.torque;
    torques.applied[i] = (1.0 + a.torque_error) * joint.torque +
                         a.ripple * std::sin(a.ripple_cycles * position[i]) -
                         joint.friction.torque(position[i], velocity[i]) - a.viscous * velocity[i];
  }
  started_ = true;
  return torques;
}

}  // namespace touchdown::simulators
