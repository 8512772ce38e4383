#pragma once

#include <span>
#include <vector>

#include "models/robot_model.hpp"
#include "simulators/friction.hpp"
#include "simulators/options.hpp"

namespace touchdown::simulators {

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
