#include "simulators/held_servos.hpp"

#include <algorithm>

namespace touchdown::simulators {

HeldServos::HeldServos(const models::RobotModel& model, const StepSizes& steps)
    : torques_(model.held.size(), 0.0) {
  const double period = 1e-6 * static_cast<double>(steps.physics_us);
  for (const models::HeldJoint& held : model.held) {
    const double inertia = 1.0 / model.mj->dof_invweight0[held.dof_address];
    joints_.push_back({.reference = held.reference,
                       .kp = std::min(held.kp, 0.25 * inertia / (period * period)),
                       .kd = std::min(held.kd, 0.5 * inertia / period),
                       .effort = held.effort,
                       .viscous = std::min(held.actuator.viscous, 0.5 * inertia / period),
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
