#include "scenarios/compiled_scenes.hpp"

#include <gtest/gtest.h>

#include "scenarios/engine.hpp"
#include "simulators/registry.hpp"

namespace touchdown::scenarios {
namespace {

Scenario stairs() {
  Scenario scenario = find_scenario("scenarios/stairs.yaml");
  scenario.end.duration = 0.5;
  return scenario;
}

TEST(CompiledScenes, SharesTheModelOfScenariosThatDifferInOtherThings) {
  CompiledScenes scenes;
  const Scenario scenario = stairs();
  Scenario faster = scenario;
  faster.velocity.front().velocity = 0.9;
  faster.end.duration = 3.0;
  const auto model = scenes.of(scenario);
  EXPECT_EQ(scenes.of(faster), model);
  Scenario heavier = scenario;
  heavier.mass_scale = 1.1;
  EXPECT_NEAR(scenes.of(heavier)->mj->body_mass[1], 1.1 * model->mj->body_mass[1], 1e-12);
  Scenario smoother = scenario;
  smoother.terrain.friction *= 0.5;
  EXPECT_NE(scenes.of(smoother), model);
}

TEST(CompiledScenes, ForgetsScenesThatNobodyNeedsAnyMore) {
  CompiledScenes scenes;
  Scenario scenario = stairs();
  const std::weak_ptr<const models::RobotModel> first = scenes.of(scenario);
  for (int i = 0; i < 100; ++i) {
    scenario.terrain.friction += 1e-3;
    scenes.of(scenario);
  }
  EXPECT_TRUE(first.expired());
}

TEST(CompiledScenes, RunsOfASharedSceneAreThoseOfTheirOwn) {
  const Scenario scenario = stairs();
  CompiledScenes scenes;
  for (const std::string& name : simulators::simulator_names()) {
    const recordings::Recording own = play(scenario, name);
    for (int turn = 0; turn < 2; ++turn) {
      const auto simulator = make_simulator(scenario, name, scenes.of(scenario));
      const recordings::Recording shared = play(scenario, *simulator);
      ASSERT_EQ(shared.steps(), own.steps());
      EXPECT_EQ(shared.truth.back().base_position, own.truth.back().base_position);
      EXPECT_EQ(shared.observation.back().imu.linear_acceleration,
                own.observation.back().imu.linear_acceleration);
    }
  }
}

}  // namespace
}  // namespace touchdown::scenarios
