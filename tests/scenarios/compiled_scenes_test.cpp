#include <gtest/gtest.h>

#include "core/resources.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/generation/generate.hpp"
#include "scenarios/scenario_file.hpp"
#include "simulators/registry.hpp"

namespace touchdown::scenarios {
namespace {

Scenario stairs() {
  Scenario scenario = find_scenario("scenarios/stairs.yaml");
  scenario.end.duration = 0.5;
  return scenario;
}

TEST(CompiledScenes, ApplyTheDeviationsOfTheRobot) {
  CompiledScenes scenes;
  Scenario scenario = stairs();
  scenario.robot = find_resource("models/upkie_actuated.yaml");
  const auto model = scenes.of(scenario);
  scenario.deviations = {.com_x = 0.01,
                         .com_z = -0.02,
                         .wheel_radius_scale = 1.1,
                         .actuator_friction_scale = 2.0,
                         .torque_error = {0.0, 0.05, 0.0, 0.0, 0.0, -0.1}};
  const auto other = scenes.of(scenario);
  ASSERT_NE(other, model);
  const int base = model->base_body;
  EXPECT_NEAR(other->mj->body_ipos[3 * base], model->mj->body_ipos[3 * base] + 0.01, 1e-15);
  EXPECT_NEAR(other->mj->body_ipos[3 * base + 2], model->mj->body_ipos[3 * base + 2] - 0.02, 1e-15);
  EXPECT_NEAR(other->wheel_radius, 0.055, 1e-15);
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    EXPECT_EQ(other->actuator[i].friction, 2.0 * model->actuator[i].friction);
    EXPECT_EQ(other->actuator[i].torque_error, scenario.deviations.torque_error[i]);
  }
  // The recorded scenario, which a run is repeated from, contains them.
  const Scenario again = scenario_from_yaml(YamlDocument::parse(to_yaml(scenario), "again.yaml"));
  EXPECT_TRUE(again.deviations == scenario.deviations);
}

TEST(CompiledScenes, GiveTheSameRunsAsSceneCompiledForOneRun) {
  const Scenario scenario = stairs();
  CompiledScenes scenes;
  for (const std::string& name : simulators::simulator_names()) {
    const logs::Recording own = play(scenario, name);
    for (int turn = 0; turn < 2; ++turn) {
      const auto simulator = make_simulator(scenario, name, scenes.of(scenario));
      const logs::Recording shared = play(scenario, *simulator);
      ASSERT_EQ(shared.steps(), own.steps());
      EXPECT_EQ(shared.truth.back().base_position, own.truth.back().base_position);
      EXPECT_EQ(shared.observation.back().imu.linear_acceleration,
                own.observation.back().imu.linear_acceleration);
    }
  }
}

}  // namespace
}  // namespace touchdown::scenarios
