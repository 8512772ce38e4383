#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulators/simulator.hpp"

namespace touchdown::simulators {

/// A physics engine that files can name.
struct SimulatorEntry {
  std::string name;     ///< used in files
  std::string title;    ///< for tables and figures
  std::string summary;  ///< one line
  std::unique_ptr<Simulator> (*make)(const std::shared_ptr<const models::RobotModel>& model,
                                     const SimulatorOptions& options);
};

std::span<const SimulatorEntry> simulator_entries();
const std::vector<std::string>& simulator_names();

/// The title of an engine, "MuJoCo"; an unknown name is returned unchanged.
std::string simulator_title(const std::string& name);

/// Makes the engine called `name` for `model`. Contact and time step come from `options`, not from
/// Errors: `InputError` for an unknown engine, or a model that it cannot represent.
std::unique_ptr<Simulator> make_simulator(std::string_view name,
                                          const std::shared_ptr<const models::RobotModel>& model,
                                          const SimulatorOptions& options);

}  // namespace touchdown::simulators
