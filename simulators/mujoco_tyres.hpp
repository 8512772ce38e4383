#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "models/robot_model.hpp"

namespace touchdown::simulators {

/// The tyres of a robot in MuJoCo.
class MujocoTyres {
 public:
  /// `engine_model` may have fewer geoms than the robot's model.
  MujocoTyres(const models::RobotModel& robot, const mjModel& engine_model);

  /// Which wheel's tyre a geom of the engine's model is of, if any.
  std::optional<std::size_t> wheel_of(int geom) const {
    return wheel_of_geom_[static_cast<std::size_t>(geom)];
  }

  /// Between `mj_step1` and `mj_step2`: makes them springs and dampers. MuJoCo's contacts are
  /// accelerations that the solver tries to reach, whatever mass there is; but a row
  ///
  ///     f = (a_ref − a)/R
  ///
  /// is a force F that hardly depends on what moves, where a_ref = R·F and R is large beside the
  /// inverse mass at the contact. Only normal rows are changed: friction stays MuJoCo's, within the
  /// friction cone of that force.
  void press(mjData& data) const;

 private:
  models::Tyre tyre_;
  double share_;  ///< of a strip in its tyre
  std::vector<std::optional<std::size_t>> wheel_of_geom_;
};

}  // namespace touchdown::simulators
