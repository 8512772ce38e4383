#include "scenarios/compiled_scenes.hpp"

#include "core/fields.hpp"
#include "models/resizing.hpp"
#include "models/terrain_yaml.hpp"

namespace touchdown::scenarios {

namespace {

/// Applies the deviations to the robot that its file describes.
void deviate(models::RobotModel& model, const Deviations& deviations) {
  models::shift_mass(*model.mj, model.base_body, {deviations.com_x, 0.0, deviations.com_z});
  models::scale_wheels(*model.mj, deviations.wheel_radius_scale);
  model.wheel_radius *= deviations.wheel_radius_scale;
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    models::Actuator& actuator = model.actuator[i];
    actuator.friction *= deviations.actuator_friction_scale;
    actuator.viscous *= deviations.actuator_friction_scale;
    actuator.torque_error += deviations.torque_error[i];
  }
}

/// The parts of a scenario that determine its scene, as YAML.
std::string scene_of(const Scenario& scenario) {
  Scenario scene;
  scene.robot = scenario.robot;
  scene.terrain = scenario.terrain;
  scene.mass_scale = scenario.mass_scale;
  scene.deviations = scenario.deviations;
  return to_yaml(scene);
}

}  // namespace

models::RobotModel compile_robot(const Scenario& scenario) {
  models::RobotModel model = models::compile_robot_model(scenario.robot, scenario.terrain);
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
  scenario.mass_scale = 1.0;
  scenario.deviations = {};
  return of(scenario);
}

}  // namespace touchdown::scenarios
