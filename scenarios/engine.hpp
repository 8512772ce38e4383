#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>

#include "recordings/recording.hpp"
#include "scenarios/scenario.hpp"
#include "simulators/simulator.hpp"

namespace touchdown::scenarios {

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

/// A recording's description of its run.
recordings::RecordingInfo recording_info(const Scenario& scenario, std::string_view simulator,
                                         std::uint64_t seed, std::int64_t run);

/// Simulates `scenario` as it is, without random draws, and records every control step. Falling,
/// running out of time and diverging are outcomes, not errors. `seed` and `run` are only stored in
/// the recording's info. `simulator` comes from `make_simulator` for a scenario with the same
/// robot, terrain, mass and simulation; it is reset first, so it can be used again. If
/// `contact_source` is given, it replaces the scenario's contact source, with the same delay.
recordings::Recording play(const Scenario& scenario, simulators::Simulator& simulator,
                           std::uint64_t seed = 0, std::int64_t run = 0,
                           const ContinueSimulation& progress = {},
                           policies::WheelContact contact_source = {});

/// As above, in a new simulator.
recordings::Recording play(const Scenario& scenario, std::string_view simulator,
                           std::uint64_t seed = 0, std::int64_t run = 0,
                           const ContinueSimulation& progress = {});

}  // namespace touchdown::scenarios
