#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "models/robot.hpp"
#include "models/robot_model.hpp"
#include "simulators/physics.hpp"
#include "simulators/servo.hpp"

namespace touchdown {

/// How finely time is cut, as whole microseconds so that no step is ever rounded.
struct StepSizes {
  /// One step of the physics engine (µs).
  std::int64_t physics_us = 1000;
  /// One turn of the control loop (µs): a multiple of the physics step.
  std::int64_t control_us = 1000;
};

/// A wrench on the base from outside the robot, held over one control step.
struct ExternalWrench {
  /// Force in the world frame (N).
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  /// Where it pulls, in the base frame (m).
  Eigen::Vector3d point_in_base = Eigen::Vector3d::Zero();
};

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

  /// Apply `action` and `wrench` for one control step.
  void step(const Action& action, const ExternalWrench& wrench = {});

  const Observation& observation() const { return observation_; }
  const GroundTruth& ground_truth() const { return truth_; }
  const RobotState& state() const { return state_; }
  const RobotModel& model() const { return *model_; }
  const StepSizes& step_sizes() const { return step_sizes_; }
  double control_period() const { return 1e-6 * static_cast<double>(step_sizes_.control_us); }

  /// False once a position or velocity is not finite or larger than anything physical.
  bool healthy() const;

 protected:
  Simulator(std::shared_ptr<const RobotModel> model, const StepSizes& step_sizes);

  /// Place the robot; called with a state of finite numbers.
  virtual void place(const RobotState& start) = 0;
  /// Advance one physics step under joint torques (servo order, N·m) and a wrench on the base.
  virtual void advance(const JointTorques& torques, const ExternalWrench& wrench) = 0;
  /// Where the robot is now.
  virtual void read(RobotState& state) const = 0;
  /// The contact forces of the physics step that just ended.
  virtual void read(ContactForces& forces) const = 0;

 private:
  void sense(const Eigen::Vector3d& imu_velocity_before, const JointTorques& torques);

  std::shared_ptr<const RobotModel> model_;
  StepSizes step_sizes_;
  std::int64_t step_count_ = 0;
  RobotState state_;
  ContactForces forces_;
  Observation observation_;
  GroundTruth truth_;
};

}  // namespace touchdown
