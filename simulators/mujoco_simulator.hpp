#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "models/robot_model.hpp"
#include "simulators/simulator.hpp"

namespace touchdown::simulators {

/// The tyres of a robot in MuJoCo.
class MujocoTyres {
 public:
  /// `engine_model` may have fewer geoms than the robot's model.
  MujocoTyres(const models::RobotModel& robot, const mjModel& engine_model);

  /// The wheel with a tyre that contains this geom of the engine's model, if any.
  std::optional<std::size_t> wheel_of(int geom) const {
    return wheel_of_geom_[static_cast<std::size_t>(geom)];
  }

  /// Makes tyre contacts springs and dampers; called between `mj_step1` and `mj_step2`. MuJoCo's
  /// contacts are reference accelerations, which the solver tries to reach for any mass. But a row
  ///
  ///     f = (a_ref − a)/R
  ///
  /// with a_ref = R·F and R much larger than the inverse mass at the contact is a force F that
  /// hardly depends on the motion. Only normal rows are changed. Friction stays MuJoCo's, within
  /// the friction cone of that force.
  void press(mjData& data) const;

 private:
  models::Tyre tyre_;
  double share_;  ///< of one strip in its tyre
  std::vector<std::optional<std::size_t>> wheel_of_geom_;
};

/// MuJoCo as a `Simulator`: it steps a copy of the compiled model.
class MujocoSimulator : public Simulator {
 public:
  MujocoSimulator(const std::shared_ptr<const models::RobotModel>& model,
                  const SimulatorOptions& options);

  std::string_view name() const override { return "mujoco"; }

  /// The model that the engine steps: without geoms that cannot collide, and with the time step and
  /// the contact model of the options.
  const mjModel& engine_model() const { return *mj_; }
  const mjData& engine_data() const { return *data_; }

 protected:
  void place(const RobotState& start) override;
  void advance(const AppliedTorques& torques, std::span<const ExternalWrench> wrenches) override;
  void read(RobotState& state) const override;
  void read(ContactForces& forces) const override;

 private:
  models::MjModelPtr mj_;
  models::MjDataPtr data_;
  MujocoTyres tyres_;
  Eigen::Vector3d base_com_;  ///< centre of mass of the base body in its frame (m)
};

}  // namespace touchdown::simulators
