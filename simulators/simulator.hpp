#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "models/robot.hpp"
#include "models/robot_model.hpp"
#include "simulators/actuators.hpp"
#include "simulators/options.hpp"

namespace touchdown::simulators {

/// Configuration and velocity of the robot, from which an engine starts.
/// World frame: x forward, y left, z up.
struct RobotState {
  /// Origin of the base frame (m).
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  /// From the base frame to the world.
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  /// Velocity of the base frame's origin, in the world (m/s).
  Eigen::Vector3d linear_velocity = Eigen::Vector3d::Zero();
  /// Angular velocity of the base, in the world (rad/s).
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  /// Joint angles (rad) and velocities (rad/s), in servo order.
  std::array<double, models::servo_count> joint_position = {};
  std::array<double, models::servo_count> joint_velocity = {};
  /// The same of `RobotModel::others`. A start needs none: cranks and rods follow hip and knee, and
  /// held joints are at their references, at rest.
  std::vector<double> other_position = {};
  std::vector<double> other_velocity = {};
};

/// Torques on the joints over one physics step (N·m).
struct AppliedTorques {
  JointTorques servo = {};
  std::span<const double> held;  ///< in the model's order
};

/// An external force on the base, constant over one control step.
struct ExternalWrench {
  /// Force in the world frame (N).
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  /// Point of application, in the base frame (m).
  Eigen::Vector3d point_in_base = Eigen::Vector3d::Zero();
};

/// The torque of `wrench` about a point of the base (base frame, m), in the world frame (N·m).
inline Eigen::Vector3d torque_about(const Eigen::Vector3d& pivot_in_base,
                                    const ExternalWrench& wrench, const RobotState& state) {
  const Eigen::Vector3d lever = state.orientation * (wrench.point_in_base - pivot_in_base);
  return lever.cross(wrench.force);
}

/// Contact forces of one physics step.
struct ContactForces {
  /// Normal force on each tyre from the terrain (N).
  std::array<double, models::wheel_count> wheel_normal_force = {0.0, 0.0};
  /// Whether a part other than a tyre touches the terrain.
  bool body_touches_terrain = false;
};

/// The interface of physics engines: a robot on a terrain, stepped by actions.
///
/// This class implements the parts that all engines share: servo law, actuators, held joints,
/// rolling resistance, IMU and contact. An engine implements the protected functions, which move
/// the bodies.
class Simulator {
 public:
  virtual ~Simulator() = default;
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;

  /// "mujoco", "bullet".
  virtual std::string_view name() const = 0;

  /// Puts the robot at `start` at time zero. The same start gives the same bits afterwards.
  void reset(const RobotState& start);

  /// Applies `action` and the external forces for one control step.
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

  /// False if a position or velocity is not finite, or too large to be physical.
  bool healthy() const;

 protected:
  Simulator(std::shared_ptr<const models::RobotModel> model, const SimulatorOptions& options);
  double physics_period() const { return 1e-6 * static_cast<double>(options_.steps.physics_us); }

  /// Places the robot. All numbers of `start` are finite.
  virtual void place(const RobotState& start) = 0;
  /// Advances one physics step under joint torques and wrenches on the base.
  virtual void advance(const AppliedTorques& torques, std::span<const ExternalWrench> wrenches) = 0;
  /// Reads the current state of the robot.
  virtual void read(RobotState& state) const = 0;
  /// Reads the contact forces of the last physics step.
  virtual void read(ContactForces& forces) const = 0;
  /// `RobotModel::others`.
  const std::vector<int>& others() const { return others_; }

 private:
  Eigen::Vector3d imu_velocity() const;
  /// Updates observation and truth. `velocity_before`: of the IMU a control step ago (m/s, world).
  void observe(const Eigen::Vector3d& velocity_before, const Actuators::Torques& torques);
  /// Reads where the motors of closed legs are, and what they do to the virtual legs.
  void update_leg_motors();
  /// Torques of motors over the last step as those at hips and knees; open legs keep theirs.
  JointTorques at_virtual_legs(JointTorques torques) const;
  void observe_leg_motors(const JointTorques& reported_torques);

  std::shared_ptr<const models::RobotModel> model_;
  std::vector<int> others_;
  SimulatorOptions options_;
  Actuators actuators_;
  LegMotors leg_motors_;
  HeldServos held_servos_;
  std::int64_t step_count_ = 0;
  RobotState state_;
  ContactForces forces_;
  Eigen::Vector3d imu_position_in_base_;
  Eigen::Matrix3d imu_rotation_in_base_;
  models::Observation observation_;
  models::GroundTruth truth_;
};

}  // namespace touchdown::simulators
