#include "scenarios/rollout.hpp"

#include <cmath>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/engine.hpp"
#include "tests/scenarios/runs.hpp"

namespace touchdown::scenarios {
namespace {

/// The base's positions along a run; `use` may give commands before each step.
template <typename Use>
std::vector<Eigen::Vector3d> path_of(Rollout& rollout, const simulators::Simulator& simulator,
                                     Use use) {
  std::vector<Eigen::Vector3d> path;
  for (std::size_t step = 0;; ++step) {
    use(rollout, step);
    rollout.act();
    path.push_back(simulator.ground_truth().base_position);
    if (rollout.outcome()) return path;
    rollout.advance();
  }
}

class RolloutTest : public ::testing::TestWithParam<const char*> {};

TEST_P(RolloutTest, RepeatsWhatWasCommandedDuringTheRun) {
  const Scenario scenario = standing(2.5);
  const auto simulator = make_simulator(scenario, GetParam());
  Rollout driven(scenario, *simulator);
  const auto path = path_of(driven, *simulator, [](Rollout& rollout, std::size_t step) {
    if (step == 300) rollout.drive(0.4, 0.0);
    if (step == 700) rollout.drive(0.4, 0.5);
    if (step == 700) rollout.drive(0.2, 0.3);  // replaces the one before
    if (step == 900) rollout.crouch(0.8, 1.0);
    if (step == 1100) rollout.crouch(0.5, 2.0, 0.4);
    if (step == 1300) rollout.apply({.time = 1.31, .duration = 0.1, .force = {8.0, -3.0, 20.0}});
  });
  // Through the file's text, as a recording keeps it.
  const Scenario repeated =
      scenario_from_yaml(YamlDocument::parse(to_yaml(driven.scenario()), "driven"));
  const logs::Recording again = play(repeated, GetParam());
  ASSERT_EQ(again.steps(), path.size());
  for (std::size_t k = 0; k < path.size(); ++k) {
    ASSERT_EQ(again.truth[k].base_position, path[k]) << "step " << k;
  }
  // The commands had an effect.
  EXPECT_GT((play(scenario, GetParam()).truth.back().base_position - path.back()).norm(), 0.05);
}

TEST_P(RolloutTest, ReplacesTheRestOfAScript) {
  Scenario scenario = standing(1.5);
  scenario.velocity = {{0.2, 0.3, 0.0}, {1.0, 1.0, 0.0}};
  scenario.crouch = {{0.1, 0.5, 1.0}, {1.2, 0.9, 1.0}};
  const auto simulator = make_simulator(scenario, GetParam());
  Rollout rollout(scenario, *simulator);
  path_of(rollout, *simulator, [](Rollout& driven, std::size_t step) {
    if (step == 400) {
      EXPECT_EQ(driven.driving().velocity, 0.3);
      EXPECT_EQ(driven.commanded_hip(), 0.5);
      driven.drive(-0.1, 0.2);
      driven.crouch(0.6, 1.0);
    }
    if (step == 1400) {
      EXPECT_EQ(driven.driving().velocity, -0.1);
      EXPECT_EQ(driven.driving().yaw_rate, 0.2);
      EXPECT_EQ(driven.commanded_hip(), 0.6);
    }
  });
  EXPECT_EQ(rollout.scenario().velocity.size(), 2u);
  EXPECT_EQ(rollout.scenario().crouch.size(), 2u);
}

TEST_P(RolloutTest, TakesNoCommandsAfterItsEnd) {
  const Scenario scenario = standing(0.2);
  const auto simulator = make_simulator(scenario, GetParam());
  Rollout rollout(scenario, *simulator);
  path_of(rollout, *simulator, [](Rollout&, std::size_t) {});
  const std::string before = to_yaml(rollout.scenario());
  rollout.drive(1.0, 0.0);
  rollout.crouch(0.9, 1.0);
  rollout.apply({.time = 0.2, .duration = 0.1, .force = {8.0, 0.0, 0.0}});
  EXPECT_EQ(to_yaml(rollout.scenario()), before);
}

TEST_P(RolloutTest, GivesTheContactSourceTheActionOfTheStepBefore) {
  using Law = policies::PolicyConfig::Law;
  for (const Law law : {Law::balancer, Law::soft_landing}) {
    for (const double delay : {0.0, 0.005}) {
      Scenario scenario = standing(0.2);
      scenario.velocity = {{0.05, 0.5, 0.3}};
      scenario.crouch = {{0.05, 0.6, 2.0}};
      scenario.policy.law = law;
      scenario.policy.delay = delay;
      const auto same = [](double a, double b) {
        return a == b || (std::isnan(a) && std::isnan(b));
      };
      std::vector<std::optional<models::Action>> given;
      const auto source = [&](const models::Observation&, const models::Action* previous) {
        given.push_back(previous == nullptr ? std::nullopt : std::optional(*previous));
        return std::array<bool, 2>{true, true};
      };
      const auto simulator = make_simulator(scenario, GetParam());
      for (int attempt = 0; attempt < 2; ++attempt) {  // the second on a simulator that was used
        given.clear();
        const logs::Recording run = play(scenario, *simulator, 0, 0, {}, source);
        ASSERT_EQ(given.size(), run.steps());
        EXPECT_FALSE(given.front());
        for (std::size_t k = 1; k < given.size(); ++k) {
          ASSERT_TRUE(given[k]);
          for (std::size_t i = 0; i < models::servo_count; ++i) {
            const models::ServoCommand& command = run.action[k - 1].servo[i];
            EXPECT_TRUE(same(given[k]->servo[i].position, command.position)) << k;
            EXPECT_TRUE(same(given[k]->servo[i].velocity, command.velocity)) << k;
            EXPECT_TRUE(same(given[k]->servo[i].kp_scale, command.kp_scale)) << k;
          }
        }
      }
    }
  }
}

TEST_P(RolloutTest, RepeatsRecordedContactOfThePolicy) {
  // The decisions of a wrong contact source are only in its record.
  Scenario scenario = standing(2.0);
  scenario.velocity = {{0.1, 0.5, 0.0}};
  policies::ContactScript script;
  const auto source = [&](const models::Observation& observation,
                          const models::Action* /*previous*/) {
    const auto tenth = static_cast<int>(observation.time / 0.1);
    const std::array<bool, 2> contact = {tenth % 3 != 0, tenth % 5 != 0};
    if (script.empty() || script.back().left != contact[0] || script.back().right != contact[1]) {
      script.push_back({observation.time, contact[0], contact[1]});
    }
    return contact;
  };
  const auto simulator = make_simulator(scenario, GetParam());
  const logs::Recording first = play(scenario, *simulator, 0, 0, {}, source);
  Scenario repeated = scenario;
  repeated.policy.contact = "script";
  repeated.policy.contact_script = script;
  repeated = scenario_from_yaml(YamlDocument::parse(to_yaml(repeated), "repeated"));
  const logs::Recording again = play(repeated, GetParam());
  ASSERT_EQ(again.steps(), first.steps());
  EXPECT_EQ(again.truth.back().base_position, first.truth.back().base_position);
  EXPECT_NE(play(scenario, GetParam()).truth.back().base_position,
            first.truth.back().base_position);
}

INSTANTIATE_TEST_SUITE_P(Engines, RolloutTest, ::testing::Values("mujoco", "bullet"),
                         [](const auto& engine) { return std::string(engine.param); });

}  // namespace
}  // namespace touchdown::scenarios
