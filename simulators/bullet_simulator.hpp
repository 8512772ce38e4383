#pragma once

#include <memory>
#include <string_view>

#include "simulators/simulator.hpp"

namespace touchdown::simulators {

class BulletWorld;
class Rotors;

/// Bullet as a `Simulator`, in double precision. Every reset builds a new world: only a new world
/// gives the same bits again.
class BulletSimulator : public Simulator {
 public:
  BulletSimulator(const std::shared_ptr<const models::RobotModel>& model,
                  const SimulatorOptions& options);
  ~BulletSimulator() override;

  std::string_view name() const override { return "bullet"; }

 protected:
  /// The engine's own world; a reset replaces it.
  BulletWorld& bullet() { return *world_; }

  void place(const RobotState& start) override;
  void advance(const AppliedTorques& torques, std::span<const ExternalWrench> wrenches) override;
  void read(RobotState& state) const override;
  void read(ContactForces& forces) const override;

 private:
  std::unique_ptr<BulletWorld> world_;
  std::unique_ptr<Rotors> rotors_;
  Eigen::Vector3d base_com_;           ///< centre of mass of the base body in its frame (m)
  Eigen::Quaterniond base_principal_;  ///< its principal axes in its frame
};

}  // namespace touchdown::simulators
