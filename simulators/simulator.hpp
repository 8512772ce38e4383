#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include <Eigen/Core>

#include "models/robot.hpp"
#include "models/robot_model.hpp"
#include "simulators/options.hpp"
#include "simulators/physics.hpp"

namespace touchdown::simulators {

/// The seam for physics engines: a robot on a terrain, stepped by actions.
///
/// What every engine shares lives here: the servo law, the rolling resistance, the IMU and what
/// counts as contact. An engine only has to move the bodies (see the protected functions).
class Simulator {
 public:
  virtual ~Simulator() = default;
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  /// "mujoco", "bullet".
  virtual std::string_view name() const = 0;

  /// Put the robot at `start` with zero time. The same start gives the same bits afterwards.
  void reset(const RobotState& start);

  /// Apply `action` and what pulls at the robot from outside for one control step.
  void step(const models::Action& action, std::span<const ExternalWrench> wrenches = {});
  void step(const models::Action& action, const ExternalWrench& wrench) {
    step(action, {&wrench, 1});
  }

  const models::Observation& observation() const { return observation_; }
  const models::GroundTruth& ground_truth() const { return truth_; }
  const RobotState& state() const { return state_; }
  const models::RobotModel& model() const { return *model_; }
  const SimulatorOptions& options() const { return options_; }
  /// Seconds per call of `step`.
  double control_period() const { return 1e-6 * static_cast<double>(options_.steps.control_us); }

  /// False once a position or velocity is not finite or larger than anything physical.
  bool healthy() const;

 protected:
  Simulator(std::shared_ptr<const models::RobotModel> model, const SimulatorOptions& options);
  double physics_period() const { return 1e-6 * static_cast<double>(options_.steps.physics_us); }

  /// Place the robot; called with a state of finite numbers.
  virtual void place(const RobotState& start) = 0;
  /// Advance one physics step under joint torques (servo order, N·m) and wrenches on the base.
  virtual void advance(const JointTorques& torques, std::span<const ExternalWrench> wrenches) = 0;
  /// Where the robot is now.
  virtual void read(RobotState& state) const = 0;
  /// The contact forces of the physics step that just ended.
  virtual void read(ContactForces& forces) const = 0;

 private:
  Eigen::Vector3d imu_velocity() const;
  void observe(const Eigen::Vector3d& imu_acceleration, const JointTorques& measured_torques);

  std::shared_ptr<const models::RobotModel> model_;
  SimulatorOptions options_;
  std::int64_t step_count_ = 0;
  RobotState state_;
  ContactForces forces_;
  Eigen::Vector3d imu_position_in_base_;
  Eigen::Matrix3d imu_rotation_in_base_;
  models::Observation observation_;
  models::GroundTruth truth_;
};

}  // namespace touchdown::simulators
