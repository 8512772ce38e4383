#pragma once

#include <array>
#include <deque>

#include "models/robot.hpp"
#include "models/robot_model.hpp"
#include "simulators/options.hpp"

namespace touchdown::simulators {

/// One number per joint, in servo order.
using JointTorques = std::array<double, models::servo_count>;

/// The six actuators of a robot at work (models/actuator.hpp), the same in every engine: from
/// commands to what servos report and what joints feel. All but the rotors' inertia, which is the
/// engine's.
class Actuators {
 public:
  Actuators(const models::RobotModel& model, const StepSizes& steps);

  /// At rest, without friction's memory.
  void reset();

  /// Once per control step: what the servos work on, the commands of some time ago. Until then the
  /// first ones count.
  const models::Action& delayed(const models::Action& action);

  struct Torques {
    JointTorques reported = {};  ///< what the servos believe
    JointTorques felt = {};      ///< by the joints, without what the ground does to a wheel
  };

  /// One physics step, at these joint positions (rad) and velocities (rad/s).
  Torques step(const models::Action& action, const JointTorques& position,
               const JointTorques& velocity);

  /// Whether joints feel what servos report.
  bool are_ideal() const { return ideal_; }

 private:
  /// Friction's elastic presliding, and the motor's lag.
  struct Joint {
    models::Actuator actuator;
    double effort = 0.0;
    double stiffness = 0.0;  ///< of presliding, as stiff as the time step allows (N·m/rad)
    double damping = 0.0;    ///< of presliding, critical (N·m·s/rad)
    double lag_gain = 1.0;   ///< per physics step
    std::size_t delay = 0;   ///< control steps
    double torque = 0.0;     ///< that the servo believes (N·m)
    double held = 0.0;       ///< by the presliding's spring (N·m)
    double position = 0.0;   ///< at the last step (rad)
  };

  /// What friction holds against the joint, which has come to `position` with `velocity`.
  static double friction(Joint& joint, double position, double velocity);

  std::array<Joint, models::servo_count> joint_;
  bool ideal_;
  bool started_ = false;
  std::size_t longest_delay_ = 0;
  std::deque<models::Action> commands_;  ///< the last ones, oldest first
  models::Action at_work_;
};

}  // namespace touchdown::simulators
