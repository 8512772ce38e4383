#pragma once

#include <array>
#include <deque>

#include "models/robot.hpp"
#include "models/robot_model.hpp"
#include "simulators/friction.hpp"
#include "simulators/options.hpp"

namespace touchdown::simulators {

/// One number per joint, in servo order.
using JointTorques = std::array<double, models::servo_count>;

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
    JointTorques reported = {};  ///< by the servos
    JointTorques applied = {};   ///< to the joints, without forces from the ground
  };

  /// Simulates one physics step, at these joint positions (rad) and velocities (rad/s).
  Torques step(const models::Action& action, const JointTorques& position,
               const JointTorques& velocity);

  /// Whether joints get the torques that servos report.
  bool are_ideal() const { return ideal_; }

 private:
  /// State of the friction and of the motor's lag.
  struct Joint {
    models::Actuator actuator;
    double effort = 0.0;
    JointFriction friction;
    double lag_gain = 1.0;  ///< per physics step
    std::size_t delay = 0;  ///< control steps
    double torque = 0.0;    ///< that the servo reports (N·m)
  };

  std::array<Joint, models::servo_count> joint_;
  bool ideal_;
  bool started_ = false;
  std::size_t longest_delay_ = 0;
  std::deque<models::Action> commands_;  ///< the last ones, oldest first
  models::Action executed_;
};

}  // namespace touchdown::simulators
