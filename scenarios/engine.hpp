#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "logs/recording.hpp"
#include "models/robot_model.hpp"
#include "scenarios/scenario.hpp"
#include "simulators/simulator.hpp"

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

/// Called every 256 steps with the simulated time (s). Returning false stops the run early.
using ContinueSimulation = std::function<bool(double time)>;

/// Makes a simulator of the scenario's robot and terrain. `name` is the engine: "mujoco", "bullet".
/// Errors: `InputError` for an unknown engine or a robot that breaks the naming contract.
std::unique_ptr<simulators::Simulator> make_simulator(const Scenario& scenario,
                                                      std::string_view name);

/// As above, with a scene that `compile_scene` compiled.
std::unique_ptr<simulators::Simulator> make_simulator(
    const Scenario& scenario, std::string_view name,
    const std::shared_ptr<const models::RobotModel>& scene);

/// A recording's description of a run that `simulator` plays.
logs::RecordingInfo recording_info(const Scenario& scenario, const simulators::Simulator& simulator,
                                   std::uint64_t seed, std::int64_t run);

/// Simulates `scenario` as it is, without random draws, and records every control step. Falling,
/// running out of time and diverging are outcomes, not errors. `seed` and `run` are only stored in
/// the recording's info. `simulator` comes from `make_simulator` for a scenario with the same
/// robot, terrain, mass and simulation; it is reset first, so it can be used again. If
/// `contact_source` is given, it replaces the scenario's contact source, with the same delay.
logs::Recording play(const Scenario& scenario, simulators::Simulator& simulator,
                     std::uint64_t seed = 0, std::int64_t run = 0,
                     const ContinueSimulation& progress = {},
                     policies::WheelContact contact_source = {});

/// As above, in a new simulator.
logs::Recording play(const Scenario& scenario, std::string_view simulator, std::uint64_t seed = 0,
                     std::int64_t run = 0, const ContinueSimulation& progress = {});

}  // namespace touchdown::scenarios
