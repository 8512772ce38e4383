#include "simulators/friction.hpp"

#include <algorithm>
#include <cmath>

namespace touchdown::simulators {

JointFriction::JointFriction(const models::Actuator& actuator, double inertia, double period)
    : limit_(actuator.friction),
      // The limit keeps the spring's oscillation with the joint's inertia below 0.5 rad per step.
      stiffness_(std::min(actuator.presliding_stiffness, 0.25 * inertia / (period * period))),
      damping_(2.0 * std::sqrt(stiffness_ * inertia)) {}

double JointFriction::torque(double position, double velocity) {
  torque_ = std::clamp(torque_ + stiffness_ * (position - position_), -limit_, limit_);
  position_ = position;
  return std::clamp(torque_ + damping_ * velocity, -limit_, limit_);
}

}  // namespace touchdown::simulators
