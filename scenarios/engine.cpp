#include "scenarios/engine.hpp"

#include <memory>
#include <utility>

#include "core/fields.hpp"
#include "models/resizing.hpp"
#include "models/terrain.hpp"
#include "scenarios/rollout.hpp"
#include "simulators/registry.hpp"

namespace touchdown::scenarios {

namespace {

/// Applies the deviations to the robot that its file describes.
void deviate(models::RobotModel& model, const Deviations& deviations) {
  models::shift_mass(*model.mj, model.base_body, {deviations.com_x, 0.0, deviations.com_z});
  model.mj->body_mass[model.base_body] += deviations.payload;
  models::scale_wheels(model, deviations.wheel_radius_scale);
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    models::Actuator& actuator = model.actuator[i];
    actuator.friction *= deviations.actuator_friction_scale;
    actuator.load_friction *= deviations.actuator_friction_scale;
    actuator.viscous *= deviations.actuator_friction_scale;
    actuator.torque_error += deviations.torque_error[i];
  }
}

/// The parts of a scenario that determine its scene, as YAML.
std::string scene_of(const Scenario& scenario) {
  Scenario scene;
  scene.robot = scenario.robot;
  scene.tyre = scenario.tyre;
  scene.terrain = scenario.terrain;
  scene.mass_scale = scenario.mass_scale;
  scene.deviations = scenario.deviations;
  return to_yaml(scene);
}

}  // namespace

models::RobotModel compile_robot(const Scenario& scenario) {
  models::RobotModel model =
      models::compile_robot_model(scenario.robot, scenario.terrain, scenario.tyre);
  const bool deviates = scenario.deviations != Deviations{};
  if (scenario.mass_scale != 1.0) models::scale_mass(*model.mj, scenario.mass_scale);
  if (deviates) deviate(model, scenario.deviations);
  if (scenario.mass_scale != 1.0 || deviates) models::recompute(*model.mj);
  return model;
}

std::shared_ptr<const models::RobotModel> compile_scene(const Scenario& scenario) {
  return std::make_shared<models::RobotModel>(compile_robot(scenario));
}

std::shared_ptr<const models::RobotModel> CompiledScenes::of(const Scenario& scenario) {
  const std::scoped_lock lock(mutex_);
  const std::string scene = scene_of(scenario);
  if (const auto known = compiled_.find(scene); known != compiled_.end()) return known->second;
  if (compiled_.size() == most) compiled_.clear();
  return compiled_.emplace(scene, compile_scene(scenario)).first->second;
}

std::shared_ptr<const models::RobotModel> CompiledScenes::as_described(Scenario scenario) {
  scenario.terrain = {};
  scenario.tyre = std::nullopt;
  scenario.mass_scale = 1.0;
  scenario.deviations = {};
  return of(scenario);
}

std::unique_ptr<simulators::Simulator> make_simulator(const Scenario& scenario,
                                                      std::string_view name) {
  return make_simulator(scenario, name, compile_scene(scenario));
}

std::unique_ptr<simulators::Simulator> make_simulator(
    const Scenario& scenario, std::string_view name,
    const std::shared_ptr<const models::RobotModel>& scene) {
  return simulators::make_simulator(name, scene, scenario.simulation);
}

logs::RecordingInfo recording_info(const Scenario& scenario, const simulators::Simulator& simulator,
                                   std::uint64_t seed, std::int64_t run) {
  return {.scenario = scenario.name,
          .simulator = std::string(simulator.name()),
          .seed = seed,
          .run = run,
          .control_period_us = scenario.simulation.steps.control_us,
          .outcome = std::nullopt,
          .scenario_yaml = to_yaml(scenario),
          .robot_digest = robot_digest(scenario),
          .robot_mass = mj_getTotalmass(simulator.model().mj.get())};
}

logs::Recording play(const Scenario& scenario, simulators::Simulator& simulator, std::uint64_t seed,
                     std::int64_t run, const ContinueSimulation& progress,
                     policies::WheelContact contact_source) {
  logs::Recording recording;
  recording.info = recording_info(scenario, simulator, seed, run);
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

logs::Recording play(const Scenario& scenario, std::string_view simulator, std::uint64_t seed,
                     std::int64_t run, const ContinueSimulation& progress) {
  return play(scenario, *make_simulator(scenario, simulator), seed, run, progress);
}

}  // namespace touchdown::scenarios
