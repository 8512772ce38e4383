#include "simulators/actuators.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchdown::simulators {

JointFriction::JointFriction(const models::Actuator& actuator, double inertia, double period)
    : limit_(actuator.friction), presliding_(models::presliding(actuator, inertia, period)) {}

double JointFriction::torque(double position, double velocity, double load) {
  const double limit = limit_ + load;
  torque_ = std::clamp(torque_ + presliding_.stiffness * (position - position_), -limit, limit);
  position_ = position;
  return std::clamp(torque_ + presliding_.damping * velocity, -limit, limit);
}

double servo_torque(const models::ServoCommand& command, double position, double velocity,
                    double effort) {
  double torque = command.feedforward_torque +
                  models::servo_kd * command.kd_scale * (command.velocity - velocity);
  if (!std::isnan(command.position)) {
    torque += models::servo_kp * command.kp_scale * (command.position - position);
  }
  const double limit = std::max(0.0, std::min(command.maximum_torque, effort));
  return std::clamp(torque, -limit, limit);
}

Actuators::Actuators(const models::RobotModel& model, const StepSizes& steps)
    : ideal_(std::all_of(model.actuator.begin(), model.actuator.end(),
                         [](const models::Actuator& a) { return a.is_ideal(); })),
      period_(1e-6 * static_cast<double>(steps.physics_us)) {
  const double control_period = 1e-6 * static_cast<double>(steps.control_us);
  for (std::size_t i = 0; i < joint_.size(); ++i) {
    Joint& joint = joint_[i];
    joint.actuator = model.actuator[i];
    joint.effort = model.effort[i];  // zero without a joint
    if (model.motor_joint[i] < 0) continue;
    const int dof = model.mj->jnt_dofadr[model.motor_joint[i]];
    joint.friction = JointFriction(joint.actuator, 1.0 / model.mj->dof_invweight0[dof], period_);
    if (joint.actuator.torque_lag > 0.0) {
      joint.lag_gain = -std::expm1(-period_ / joint.actuator.torque_lag);
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
    joint.torque = joint.play = joint.play_rate = 0.0;
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

void Actuators::share_among_motors(const LegMotors& motors, JointTorques& torques) const {
  for (std::size_t leg = 0; leg < motors.map.size(); ++leg) {
    if (!motors.map[leg]) continue;
    const LinkageVector shared =
        motors.map[leg]->motor_torques({torques[3 * leg], torques[3 * leg + 1]});
    torques[3 * leg + 1] = 0.0;
    for (Eigen::Index i = 0; i < shared.size(); ++i) {
      const std::size_t servo = 3 * leg + static_cast<std::size_t>(i);
      torques[servo] = std::clamp(shared[i], -joint_[servo].effort, joint_[servo].effort);
    }
  }
}

double Actuators::Joint::through_backlash(double motor_torque, double period) {
  const double flank = 0.5 * actuator.backlash;
  if (flank == 0.0 || motor_torque == 0.0) return motor_torque;
  const double rate = play_rate + motor_torque / actuator.armature * period;
  const double next = play + rate * period;
  const bool crosses = std::abs(next) < flank;
  play = std::clamp(next, -flank, flank);
  play_rate = crosses ? rate : 0.0;
  return crosses ? 0.0 : motor_torque;
}

Actuators::Torques Actuators::step(const models::Action& action, const JointTorques& position,
                                   const JointTorques& velocity, const LegMotors* motors) {
  Torques torques;
  for (std::size_t i = 0; i < joint_.size(); ++i) {
    const bool is_virtual = motors != nullptr && i % 3 != 2;
    torques.reported[i] = servo_torque(
        action.servo[i], position[i] + joint_[i].play, velocity[i] + joint_[i].play_rate,
        is_virtual ? std::numeric_limits<double>::infinity() : joint_[i].effort);
  }
  if (motors != nullptr) share_among_motors(*motors, torques.reported);
  if (ideal_) {
    torques.applied = torques.reported;
    return torques;
  }
  for (std::size_t i = 0; i < joint_.size(); ++i) {
    Joint& joint = joint_[i];
    const bool is_virtual = motors != nullptr && i % 3 != 2;
    const double angle = is_virtual ? motors->position[i] : position[i];
    const double rate = is_virtual ? motors->velocity[i] : velocity[i];
    if (!started_) joint.friction.start_at(angle);
    joint.torque += joint.lag_gain * (torques.reported[i] - joint.torque);
    const models::Actuator& a = joint.actuator;
    torques.reported[i] = joint.torque;
    const double motor =
        (1.0 + a.torque_error) * joint.torque + a.ripple * std::sin(a.ripple_cycles * angle);
    torques.applied[i] =
        joint.through_backlash(motor, period_) -
        joint.friction.torque(angle, rate, a.load_friction * std::abs(joint.torque)) -
        a.viscous * rate;
    torques.play[i] = joint.play;
    torques.play_rate[i] = joint.play_rate;
  }
  started_ = true;
  return torques;
}

HeldServos::HeldServos(const models::RobotModel& model, const StepSizes& steps)
    : torques_(model.held.size(), 0.0) {
  const double period = 1e-6 * static_cast<double>(steps.physics_us);
  for (const models::HeldJoint& held : model.held) {
    const double inertia = 1.0 / model.mj->dof_invweight0[held.dof_address];
    joints_.push_back(
        {.reference = held.reference,
         .kp = models::stable_stiffness(held.kp, models::held_share * inertia, period),
         .kd = models::stable_damping(held.kd, models::held_share * inertia, period),
         .effort = held.effort,
         .viscous = models::stable_damping(held.actuator.viscous, inertia, period),
         .friction = JointFriction(held.actuator, inertia, period)});
  }
}

void HeldServos::reset() {
  started_ = false;
  std::fill(torques_.begin(), torques_.end(), 0.0);
  for (Joint& joint : joints_) joint.friction.reset();
}

void HeldServos::step(std::span<const double> position, std::span<const double> velocity) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    Joint& joint = joints_[i];
    if (!started_) joint.friction.start_at(position[i]);
    const double servo = joint.kp * (joint.reference - position[i]) - joint.kd * velocity[i];
    torques_[i] = std::clamp(servo, -joint.effort, joint.effort) -
                  joint.friction.torque(position[i], velocity[i]) - joint.viscous * velocity[i];
  }
  started_ = true;
}

}  // namespace touchdown::simulators
