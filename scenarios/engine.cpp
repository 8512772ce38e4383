#include "scenarios/engine.hpp"

#include <memory>
#include <utility>

#include "scenarios/compiled_scenes.hpp"
#include "scenarios/rollout.hpp"
#include "simulators/registry.hpp"

namespace touchdown::scenarios {

std::unique_ptr<simulators::Simulator> make_simulator(const Scenario& scenario,
                                                      std::string_view name) {
  return make_simulator(scenario, name, compile_scene(scenario));
}

std::unique_ptr<simulators::Simulator> make_simulator(
    const Scenario& scenario, std::string_view name,
    const std::shared_ptr<const models::RobotModel>& scene) {
  return simulators::make_simulator(name, scene, scenario.simulation);
}

recordings::RecordingInfo recording_info(const Scenario& scenario, std::string_view simulator,
                                         std::uint64_t seed, std::int64_t run) {
  return {.scenario = scenario.name,
          .simulator = std::string(simulator),
          .seed = seed,
          .run = run,
          .control_period_us = scenario.simulation.steps.control_us,
          .outcome = std::nullopt,
          .scenario_yaml = to_yaml(scenario)};
}

recordings::Recording play(const Scenario& scenario, simulators::Simulator& simulator,
                           std::uint64_t seed, std::int64_t run, const ContinueSimulation& progress,
                           policies::WheelContact contact_source) {
  recordings::Recording recording;
  recording.info = recording_info(scenario, simulator.name(), seed, run);
  const auto most_steps =
      static_cast<std::size_t>(scenario.end.duration / simulator.control_period()) + 2;
  recording.observation.reserve(most_steps);
  recording.action.reserve(most_steps);
  recording.truth.reserve(most_steps);

  Rollout rollout(scenario, simulator, std::move(contact_source));
  for (std::size_t step = 0;; ++step) {
    recording.observation.push_back(simulator.observation());
    recording.action.push_back(rollout.act());
    recording.truth.push_back(simulator.ground_truth());
    recording.info.outcome = rollout.outcome();
    if (recording.info.outcome) return recording;
    constexpr std::size_t steps_between_reports = 256;
    if (progress && step % steps_between_reports == 0 && !progress(simulator.observation().time)) {
      return recording;
    }
    rollout.advance();
  }
}

recordings::Recording play(const Scenario& scenario, std::string_view simulator, std::uint64_t seed,
                           std::int64_t run, const ContinueSimulation& progress) {
  return play(scenario, *make_simulator(scenario, simulator), seed, run, progress);
}

}  // namespace touchdown::scenarios
