#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "models/robot_model.hpp"
#include "simulators/options.hpp"

namespace touchdown::simulators {

/// The options, with physics steps short enough for the robot's tyres, if these are springs and
/// dampers. For a wheel alone on its tyre, the phase of the oscillation advances by at most 0.37
/// rad per step; peaks of landings then are within six percent of continuous time. Steps never get
/// longer, and a control step remains a multiple of them.
SimulatorOptions with_steps_for_tyres(SimulatorOptions options, const models::RobotModel& model);

/// The options with at most half of those steps: the longest that divide the control step.
SimulatorOptions with_half_steps(SimulatorOptions options, const models::RobotModel& model);

/// The wheel with a tyre that contains this geom of the robot's model, if any.
std::optional<std::size_t> wheel_of_tyre(const models::RobotModel& robot, int geom);

/// A contact of a strip of a tyre.
struct TyreContact {
  std::size_t strip = 0;                              ///< any unique number
  double depth = 0.0;                                 ///< compression (m)
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of the contact, towards the tyre
};

/// Whether each contact counts. Where several pieces of ground meet below a strip, only the deepest
/// contact counts; otherwise the tyre would be twice as stiff at every joint of the ground. A
/// contact in another direction, such as a kerb, counts too.
std::vector<bool> counted_contacts(const std::vector<TyreContact>& contacts);

}  // namespace touchdown::simulators
