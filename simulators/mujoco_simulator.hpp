#pragma once

#include <memory>
#include <string_view>

#include "simulators/mujoco_tyres.hpp"
#include "simulators/simulator.hpp"

namespace touchdown::simulators {

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
