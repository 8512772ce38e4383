#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "models/robot_model.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::scenarios {

/// Compiles the robot and the terrain of a scenario. Simulators in all engines and pictures use the
/// result. Errors: `InputError` for a robot that breaks the naming contract.
models::RobotModel compile_robot(const Scenario& scenario);
/// The same, as a shared model.
std::shared_ptr<const models::RobotModel> compile_scene(const Scenario& scenario);

/// Caches compiled scenes that several runs share: compiling one takes as long as simulating a
/// second. Threads may share the cache.
class CompiledScenes {
 public:
  std::shared_ptr<const models::RobotModel> of(const Scenario& scenario);
  /// The scenario's robot alone, as its file describes it. Estimators get this model: they do not
  /// know the deviations and the load of the robot in a run.
  std::shared_ptr<const models::RobotModel> as_described(Scenario scenario);

 private:
  static constexpr std::size_t most = 16;  ///< scenes kept: some scenes have one run each

  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<const models::RobotModel>> compiled_;
};

}  // namespace touchdown::scenarios
