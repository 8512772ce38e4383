#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "recordings/recording.hpp"
#include "scenarios/scenario.hpp"
#include "simulators/simulator.hpp"

namespace touchdown::scenarios {

/// Called now and then with the simulated time (s); returning false stops the run early.
using ContinueSimulation = std::function<bool(double time)>;

/// The scene of `scenario`, robot and terrain, in the engine called `name` ("mujoco", "bullet").
/// Errors: `InputError` for an unknown engine or a robot that breaks the naming contract.
std::unique_ptr<simulators::Simulator> make_simulator(const Scenario& scenario,
                                                      std::string_view name);

/// As above, with the scene compiled already (`compile_scene`).
std::unique_ptr<simulators::Simulator> make_simulator(
    const Scenario& scenario, std::string_view name,
    const std::shared_ptr<const models::RobotModel>& scene);

/// What pulls at the robot from outside during the coming control step: its tether, its guides and
/// the timed forces that act now.
std::vector<simulators::ExternalWrench> external_wrenches(const Scenario& scenario,
                                                          const simulators::Simulator& simulator);

/// Play `scenario` exactly as it stands (no draws) and record every control step. Falling, running
/// out of time and diverging are outcomes, not errors. The recording's info carries `seed` and
/// `run` for the record. `simulator` is one that `make_simulator` made for a scenario with the same
/// robot, terrain, mass and simulation; it is reset first, so that it can be played again. `told`,
/// if it is given, tells the policy about contact instead of whom the scenario names, as late.
recordings::Recording play(const Scenario& scenario, simulators::Simulator& simulator,
                           std::uint64_t seed = 0, std::int64_t run = 0,
                           const ContinueSimulation& progress = {}, policies::WheelContact told = {});

/// As above, in a simulator of its own.
recordings::Recording play(const Scenario& scenario, std::string_view simulator,
                           std::uint64_t seed = 0, std::int64_t run = 0,
                           const ContinueSimulation& progress = {});

}  // namespace touchdown::scenarios
