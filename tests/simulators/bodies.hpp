#pragma once

#include <Eigen/Core>

#include "models/robot_model.hpp"
#include "simulators/simulator.hpp"

namespace touchdown::simulators {

/// Quantities that mechanics conserves, summed over the robot's bodies by textbook kinematics from
/// the numbers of the compiled model. It shares no code with either engine.
struct Motion {
  double mass = 0.0;                                         ///< kg
  Eigen::Vector3d centre_of_mass = Eigen::Vector3d::Zero();  ///< in the world (m)
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();        ///< kg·m/s
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();  ///< angular momentum about the centre (kg·m²/s)
  double kinetic_energy = 0.0;                     ///< J
};

Motion motion(const models::RobotModel& model, const RobotState& state);

}  // namespace touchdown::simulators
