#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "simulators/registry.hpp"
#include "tests/models/upkie.hpp"

namespace touchdown::simulators {

inline constexpr double g = 9.81;  ///< m/s²

/// Upkie on a floor; `change` modifies the compiled model.
inline std::shared_ptr<const models::RobotModel> upkie(
    const std::function<void(models::RobotModel&)>& change = {},
    const models::Terrain& terrain = {}) {
  auto model =
      std::make_shared<models::RobotModel>(models::compile_robot_model(upkie_mjcf, terrain));
  if (change) {
    change(*model);
    const models::MjDataPtr data(mj_makeData(model->mj.get()));
    mj_setConst(model->mj.get(), data.get());
  }
  return model;
}

inline void without_gravity(models::RobotModel& robot) { robot.mj->opt.gravity[2] = 0.0; }

/// One physics step per control step, of `microseconds`.
inline SimulatorOptions steps_of(std::int64_t microseconds) {
  SimulatorOptions options;
  options.steps = {microseconds, microseconds};
  return options;
}

/// An action with these torques and no servo gains.
inline models::Action torques(const JointTorques& torque = {}) {
  models::Action action;
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    action.servo[i].feedforward_torque = torque[i];
    action.servo[i].kd_scale = 0.0;
  }
  return action;
}

/// An action that holds the legs where they are in `state` and lets the wheels roll.
inline models::Action stiff_legs(const RobotState& state) {
  models::Action action = torques();
  for (const models::Servo servo : {models::Servo::left_hip, models::Servo::left_knee,
                                    models::Servo::right_hip, models::Servo::right_knee}) {
    action.servo[models::index(servo)] = {
        .position = state.joint_position[models::index(servo)], .kp_scale = 10.0, .kd_scale = 2.0};
  }
  return action;
}

inline RobotState at_height(double z) {
  RobotState state;
  state.position.z() = z;
  return state;
}

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

/// Makes a body too heavy for the robot's forces to move it within any tolerance of the tests.
inline void make_heavy(models::RobotModel& robot, int body) {
  constexpr double heavy = 1e7;  // kg, and kg·m²
  robot.mj->body_mass[body] = heavy;
  for (int axis = 0; axis < 3; ++axis) robot.mj->body_inertia[3 * body + axis] = heavy;
}

/// A stream of uniform numbers, the same on every machine.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : seed_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * uniform01(seed_, 0, count_++);
  }
  Eigen::Vector3d vector(double size) {
    const double x = between(-size, size);
    const double y = between(-size, size);
    return {x, y, between(-size, size)};
  }

 private:
  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

/// A random state high above the ground, with moving joints away from their limits.
inline RobotState random_state(Draws& draw) {
  RobotState state;
  state.position = Eigen::Vector3d(0.0, 0.0, 50.0) + draw.vector(1.0);
  state.orientation = Eigen::AngleAxisd(draw.between(0.0, 3.1), draw.vector(1.0).normalized());
  state.linear_velocity = draw.vector(2.0);
  state.angular_velocity = draw.vector(4.0);
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    state.joint_position[i] = draw.between(-1.0, 1.0);
    state.joint_velocity[i] = draw.between(-8.0, 8.0);
  }
  return state;
}

/// A test that every engine must pass.
class EveryEngine : public ::testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Simulator> make(const std::shared_ptr<const models::RobotModel>& model,
                                  const SimulatorOptions& options = {}) const {
    return make_simulator(GetParam(), model, options);
  }
};

inline std::string engine_name(const ::testing::TestParamInfo<std::string>& engine) {
  return engine.param;
}

}  // namespace touchdown::simulators
