#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "models/robot_model.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::scenarios {

/// Robot and terrain of a scenario, which its simulators in all engines and its pictures are made
/// of. Errors: `InputError` for a robot that breaks the naming contract.
models::RobotModel compile_robot(const Scenario& scenario);
/// The same, to be shared.
std::shared_ptr<const models::RobotModel> compile_scene(const Scenario& scenario);

/// Scenes that runs have in common, compiled once: compiling takes as long as a second of a run.
/// Threads may share it.
class CompiledScenes {
 public:
  std::shared_ptr<const models::RobotModel> of(const Scenario& scenario);
  /// The scenario's robot alone, as its file has it: nobody who listens to a robot knows how this
  /// very one deviates, or what it carries.
  std::shared_ptr<const models::RobotModel> as_described(Scenario scenario);

 private:
  static constexpr std::size_t most = 16;  ///< of the last ones: some scenes have one run each

  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const models::RobotModel>> compiled_;
};

}  // namespace touchdown::scenarios
