#pragma once

#include <memory>

#include "simulators/simulator.hpp"

namespace touchdown::simulators {

// The engines, each in its own source. Files name them by simulators/registry.hpp.

std::unique_ptr<Simulator> make_mujoco(const std::shared_ptr<const models::RobotModel>& model,
                                       const SimulatorOptions& options);
std::unique_ptr<Simulator> make_bullet(const std::shared_ptr<const models::RobotModel>& model,
                                       const SimulatorOptions& options);

}  // namespace touchdown::simulators
