#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "models/robot_model.hpp"
#include "simulators/options.hpp"

namespace touchdown::simulators {

/// The options with physics steps as short as the robot's tyres want them: of a wheel alone on a
/// tyre that is a spring and a damper, the oscillation turns by no more than a tenth of a radian
/// per step, which leaves landings within one percent of continuous time, and the damper takes no
/// more than a quarter of the speed. Steps are never made longer, and a control step remains a
/// whole number of them.
SimulatorOptions with_steps_for_tyres(SimulatorOptions options, const models::RobotModel& model);

/// Which wheel's tyre a geom of the robot's model is of, if any.
std::optional<std::size_t> wheel_of_tyre(const models::RobotModel& robot, int geom);

/// Where a strip of a tyre touches something.
struct TyreContact {
  std::size_t strip = 0;                              ///< whatever number it has
  double depth = 0.0;                                 ///< how far it is pressed in (m)
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< towards the tyre
};

/// Which of all contacts are the tyres'. Where several pieces of ground meet below a strip, that
/// which presses it most is its ground: it would be twice as stiff at every joint of the ground
/// otherwise. Only what presses another way, as a kerb does, counts beside it.
std::vector<bool> that_count(const std::vector<TyreContact>& contacts);

}  // namespace touchdown::simulators
