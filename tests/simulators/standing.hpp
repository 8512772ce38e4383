#pragma once

#include "tests/simulators/upkie.hpp"

namespace touchdown::simulators {

/// Upkie with straight legs, its tyres on the floor.
inline RobotState upright() { return at_height(0.507 + 0.05); }

/// Legs and wheels held at their angles in `state`.
inline models::Action locked(const RobotState& state) {
  models::Action action = stiff_legs(state);
  for (const models::Servo wheel : models::wheel_servos) {
    action.servo[models::index(wheel)] = {
        .position = state.joint_position[models::index(wheel)], .kp_scale = 0.5, .kd_scale = 0.1};
  }
  return action;
}

/// A horizontal spring and damper that keeps the base above the origin, without vertical force.
inline ExternalWrench guide(const RobotState& state) {
  Eigen::Vector3d force = -400.0 * state.position - 80.0 * state.linear_velocity;
  force.z() = 0.0;
  return {force, Eigen::Vector3d::Zero()};
}

/// Lets the robot stand for `seconds`.
inline void stand(Simulator& simulator, double seconds) {
  const models::Action action = locked(simulator.state());
  const auto steps = std::lround(seconds / simulator.control_period());
  for (long i = 0; i < steps; ++i) simulator.step(action, guide(simulator.state()));
}

}  // namespace touchdown::simulators
