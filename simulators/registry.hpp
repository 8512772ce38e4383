#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulators/simulator.hpp"

namespace touchdown::simulators {

/// One physics engine that files can name.
struct SimulatorEntry {
  std::string name;     ///< in files
  std::string title;    ///< for tables and figures
  std::string summary;  ///< one line: what it is
  std::unique_ptr<Simulator> (*make)(const std::shared_ptr<const models::RobotModel>& model,
                                     const SimulatorOptions& options);
};

std::span<const SimulatorEntry> simulator_entries();
const std::vector<std::string>& simulator_names();

/// An engine as people write it: "MuJoCo"; the name itself where there is no better one.
std::string simulator_title(const std::string& name);

/// The engine called `name`, with `model` in it. The model's contact and time step are taken from
/// `options`, not from the MJCF.
/// Errors: `InputError` naming the nearest engine; a model that the engine cannot represent.
std::unique_ptr<Simulator> make_simulator(std::string_view name,
                                          const std::shared_ptr<const models::RobotModel>& model,
                                          const SimulatorOptions& options);

}  // namespace touchdown::simulators
