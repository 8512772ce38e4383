#include <fmt/format.h>
#include <fmt/ranges.h>

#include "simulators/bullet_simulator.hpp"
#include "simulators/mujoco_simulator.hpp"
#include "simulators/simulator.hpp"

namespace touchdown {

const std::vector<std::string>& simulator_names() {
  static const std::vector<std::string> names = {"mujoco", "bullet"};
  return names;
}

std::unique_ptr<Simulator> make_simulator(std::string_view name,
                                          const std::shared_ptr<const RobotModel>& model,
                                          const SimulatorOptions& options) {
  if (name == "mujoco") return std::make_unique<MujocoSimulator>(model, options);
  if (name == "bullet") return std::make_unique<BulletSimulator>(model, options);
  const std::string near = nearest(name, simulator_names());
  throw InputError(fmt::format("unknown simulator '{}': expected one of {}{}", name,
                               fmt::join(simulator_names(), ", "),
                               near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
}

}  // namespace touchdown
