#pragma once

#include <array>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "estimator/force/linkage.hpp"
#include "models/actuator.hpp"
#include "models/robot.hpp"
#include "models/robot_model.hpp"
#include "models/simulated_joints.hpp"
#include "simulators/options.hpp"

namespace touchdown::simulators {

/// Coulomb friction of a joint, with elastic presliding (models/actuator.hpp).
class JointFriction {
 public:
  JointFriction() = default;  ///< without friction
  /// `inertia`: apparent inertia of the joint (kg·m²); `period`: physics step (s).
  JointFriction(const models::Actuator& actuator, double inertia, double period);

  /// Relaxes the presliding spring.
  void reset() { torque_ = 0.0; }
  /// The position at which the joint starts (rad).
  void start_at(double position) { position_ = position; }
  /// The torque that opposes the joint at `position` (rad) with `velocity` (rad/s), in N·m. `load`
  /// (N·m) adds to the friction.
  double torque(double position, double velocity, double load = 0.0);

 private:
  double limit_ = 0.0;  ///< N·m
  models::Presliding presliding_;
  double torque_ = 0.0;    ///< of the presliding spring (N·m)
  double position_ = 0.0;  ///< at the last step (rad)
};

/// The torque that a moteus-like servo applies to its joint (N·m):
///     clamp(feedforward + kd·kd_scale·(ω* − ω) + kp·kp_scale·(q* − q), ± limit),
/// where a NaN target position q* drops the position term and the limit is the smaller of the
/// command's maximum torque and the motor's effort.
double servo_torque(const models::ServoCommand& command, double position, double velocity,
                    double effort);

/// One number per joint, in servo order.
using JointTorques = std::array<double, models::servo_count>;

/// The motors of closed legs at one instant. They count as hip and knee; a leg with one motor has
/// none at the knee.
struct LegMotors {
  std::array<std::optional<MotorMap>, models::wheel_count> map;
  JointTorques position = {};  ///< rad
  JointTorques velocity = {};  ///< rad/s
};

/// Simulates the six actuators of a robot (models/actuator.hpp), the same in every engine. From
/// commands, it computes the torques that servos report and those applied to joints. The engine
/// simulates the rotors' inertia.
class Actuators {
 public:
  Actuators(const models::RobotModel& model, const StepSizes& steps);

  /// Returns to rest and clears friction's state.
  void reset();

  /// The delayed commands that the servos execute; called once per control step. Until the delay
  /// has passed, they are the first commands.
  const models::Action& delayed(const models::Action& action);

  struct Torques {
    JointTorques reported = {};   ///< by the servos
    JointTorques applied = {};    ///< to the joints, without forces from the ground
    JointTorques play = {};       ///< of the rotor within the backlash, ahead of its joint (rad)
    JointTorques play_rate = {};  ///< rad/s
  };

  /// Simulates one physics step, at these joint positions (rad) and velocities (rad/s). Servos of
  /// closed legs act on hip and knee of the virtual leg. Their motors share the torque by virtual
  /// work, each within its limit, and have its friction, delay and lag: torques are theirs.
  Torques step(const models::Action& action, const JointTorques& position,
               const JointTorques& velocity, const LegMotors* motors = nullptr);

  /// Whether joints get the torques that servos report.
  bool are_ideal() const { return ideal_; }

 private:
  /// State of the friction and of the motor's lag.
  struct Joint {
    models::Actuator actuator;
    double effort = 0.0;
    JointFriction friction;
    double lag_gain = 1.0;   ///< per physics step
    std::size_t delay = 0;   ///< control steps
    double torque = 0.0;     ///< that the servo reports (N·m)
    double play = 0.0;       ///< of the rotor ahead of the joint (rad)
    double play_rate = 0.0;  ///< rad/s

    /// Moves the rotor within the backlash and returns what the joint gets of the motor's torque.
    double through_backlash(double motor_torque, double period);
  };

  /// Turns torques of hips and knees of closed legs into those of their motors, within their
  /// limits.
  void share_among_motors(const LegMotors& motors, JointTorques& torques) const;

  std::array<Joint, models::servo_count> joint_;
  bool ideal_;
  bool started_ = false;
  double period_;  ///< physics step (s)
  std::size_t longest_delay_ = 0;
  std::deque<models::Action> commands_;  ///< the last ones, oldest first
  models::Action executed_;
};

/// The servos of held joints (models/robot_model.hpp), the same in every engine. Gains are limited
/// by the time step and the joint's inertia.
class HeldServos {
 public:
  HeldServos(const models::RobotModel& model, const StepSizes& steps);

  /// Clears the friction's state and the torques.
  void reset();

  /// Computes the torques of one physics step, at these positions (rad) and velocities (rad/s).
  void step(std::span<const double> position, std::span<const double> velocity);

  /// Torque of the last step on each joint (N·m).
  std::span<const double> torques() const { return torques_; }

 private:
  struct Joint {
    double reference = 0.0;
    double kp = 0.0;
    double kd = 0.0;
    double effort = 0.0;
    double viscous = 0.0;
    JointFriction friction;
  };

  std::vector<Joint> joints_;
  std::vector<double> torques_;
  bool started_ = false;
};

}  // namespace touchdown::simulators
