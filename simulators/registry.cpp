#include "simulators/registry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/yaml.hpp"
#include "simulators/engines.hpp"

namespace touchdown::simulators {

std::span<const SimulatorEntry> simulator_entries() {
  static const std::vector<SimulatorEntry> entries = {
      {"mujoco", "MuJoCo", "soft contacts by convex optimisation", make_mujoco},
      {"bullet", "Bullet", "the paper's engine: contacts by impulses", make_bullet},
  };
  return entries;
}

const std::vector<std::string>& simulator_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const SimulatorEntry& entry : simulator_entries()) all.push_back(entry.name);
    return all;
  }();
  return names;
}

std::string simulator_title(const std::string& name) {
  for (const SimulatorEntry& entry : simulator_entries()) {
    if (entry.name == name) return entry.title;
  }
  return name;
}

std::unique_ptr<Simulator> make_simulator(std::string_view name,
                                          const std::shared_ptr<const models::RobotModel>& model,
                                          const SimulatorOptions& options) {
  for (const SimulatorEntry& entry : simulator_entries()) {
    if (entry.name == name) return entry.make(model, options);
  }
  throw InputError(fmt::format("unknown simulator '{}': expected one of {}{}", name,
                               fmt::join(simulator_names(), ", "),
                               did_you_mean(name, simulator_names())));
}

}  // namespace touchdown::simulators
