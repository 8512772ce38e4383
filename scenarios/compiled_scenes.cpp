#include "scenarios/compiled_scenes.hpp"

#include "core/fields.hpp"
#include "models/terrain_yaml.hpp"

namespace touchdown::scenarios {

namespace {

/// Scales mass and inertia alike, so that the robot keeps its shape.
void scale_mass(models::RobotModel& model, double scale) {
  for (int body = 1; body < model.mj->nbody; ++body) {
    model.mj->body_mass[body] *= scale;
    for (int axis = 0; axis < 3; ++axis) model.mj->body_inertia[3 * body + axis] *= scale;
  }
  const models::MjDataPtr data(mj_makeData(model.mj.get()));
  mj_setConst(model.mj.get(), data.get());
}

/// The parts of a scenario that its scene is made of, and no others.
std::string scene_of(const Scenario& scenario) {
  Scenario scene;
  scene.robot = scenario.robot;
  scene.terrain = scenario.terrain;
  scene.mass_scale = scenario.mass_scale;
  return to_yaml(scene);
}

}  // namespace

std::shared_ptr<const models::RobotModel> compile_scene(const Scenario& scenario) {
  auto model = std::make_shared<models::RobotModel>(
      models::compile_robot_model(scenario.robot, scenario.terrain));
  if (scenario.mass_scale != 1.0) scale_mass(*model, scenario.mass_scale);
  return model;
}

std::shared_ptr<const models::RobotModel> CompiledScenes::of(const Scenario& scenario) {
  const std::scoped_lock lock(mutex_);
  const std::string scene = scene_of(scenario);
  if (const auto known = compiled_.find(scene); known != compiled_.end()) return known->second;
  if (compiled_.size() == most) compiled_.clear();
  return compiled_.emplace(scene, compile_scene(scenario)).first->second;
}

}  // namespace touchdown::scenarios
