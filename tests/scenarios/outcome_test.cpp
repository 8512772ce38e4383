#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulators/registry.hpp"
#include "tests/scenarios/runs.hpp"

namespace touchdown::scenarios {
namespace {

using logs::Outcome;
using ::testing::MatchesRegex;

class OutcomeOf : public InEveryEngine {
 protected:
  /// Plays a run and checks how it ends, as a pattern of its text.
  static logs::Recording expect(const Scenario& scenario, Outcome outcome, const char* ending) {
    logs::Recording recording = play(scenario, GetParam());
    EXPECT_EQ(recording.info.outcome, outcome);
    EXPECT_THAT(ending_text(recording, scenario.end), MatchesRegex(ending));
    return recording;
  }
};

TEST_P(OutcomeOf, AFallNamesItsAngleOrWhatTouched) {
  Scenario pushed = standing(10.0);
  pushed.forces = {{.time = 0.5, .duration = 0.5, .force = {0.0, 60.0, 0.0}}};
  const logs::Recording recording =
      expect(pushed, Outcome::fell, "fell after [0-9.]+ s: roll beyond 1 rad");
  EXPECT_LT(recording.observation.back().time, 3.0);
  EXPECT_GT(recording.observation.back().time, 0.5);

  Scenario limp = standing(10.0);  // it cannot balance
  limp.balancer.max_velocity = 0.0;
  limp.forces = {{.time = 0.2, .duration = 0.1, .force = {10.0, 0.0, 0.0}}};
  expect(limp, Outcome::fell, "fell after [0-9.]+ s: pitch beyond 1 rad");
  limp.end.fall_tilt = 0.25;
  expect(limp, Outcome::fell, "fell after [0-9.]+ s: pitch beyond 0.25 rad");

  Scenario folding = standing(10.0);
  folding.balancer.leg_kp_scale = folding.balancer.leg_kd_scale = 0.0;
  folding.end.fall_tilt = 3.0;
  expect(folding, Outcome::fell, "fell after [0-9.]+ s: a part other than a tyre touched .*");
}

TEST_P(OutcomeOf, ALateRunNamesItsPlaceAndTheFinishLine) {
  Scenario slow = standing(1.0);
  slow.end.x = 5.0;
  const logs::Recording recording = expect(
      slow, Outcome::timed_out, "timed out after 1.001 s: at x = .*before the finish line at 5 m");
  EXPECT_NEAR(recording.observation.back().time, 1.0, 1e-9);
  EXPECT_EQ(recording.steps(), 1001U);
}

TEST_P(OutcomeOf, ARunFinishesAfterItsDurationOrItsSettlingTime) {
  expect(standing(0.5), Outcome::finished, "finished after 0.501 s");
  Scenario driving = standing(10.0);
  driving.velocity = {{0.2, 0.5, 0.0}};
  driving.end.x = 0.5;
  driving.end.settle = 0.7;
  const logs::Recording recording = expect(driving, Outcome::finished, "finished after .* s");
  std::size_t passed = 0;
  while (recording.truth[passed].base_position.x() <= 0.5) ++passed;
  EXPECT_NEAR(recording.observation.back().time - recording.observation[passed].time, 0.7, 1e-6);
}

TEST_P(OutcomeOf, AnAbsurdForceIsADivergence) {
  Scenario absurd = standing(5.0);
  absurd.forces = {{.time = 0.1, .duration = 1.0, .force = {0.0, 0.0, 1e9}}};
  const logs::Recording recording =
      expect(absurd, Outcome::diverged, "diverged after [0-9.]+ s: .*");
  EXPECT_LT(recording.observation.back().time, 0.3);
}

TEST_P(OutcomeOf, AStoppedRunHasNone) {
  const Scenario scenario = standing(10.0);
  int reports = 0;
  const logs::Recording recording = play(scenario, GetParam(), 3, 4, [&](double time) {
    ++reports;
    return time < 1.0;
  });
  EXPECT_EQ(recording.info.outcome, std::nullopt);
  EXPECT_THAT(ending_text(recording, scenario.end), ::testing::StartsWith("stopped after 1"));
  EXPECT_EQ(recording.info.seed, 3U);
  EXPECT_EQ(recording.info.run, 4);
  EXPECT_GT(reports, 2);
  EXPECT_LT(recording.observation.back().time, 1.5);
}

/// Robots that meet no ground: without tyres' bits, without any bits, or dropped through a hole.
TEST_P(OutcomeOf, ARobotThatFallsThroughTheGroundIsNamed) {
  const Scenario scenario = standing(3.0);
  for (const bool whole_robot : {true, false}) {
    auto model = std::make_shared<models::RobotModel>(compile_robot(scenario));
    for (int geom = 0; geom < model->mj->ngeom; ++geom) {
      const bool is_terrain = model->mj->geom_bodyid[geom] == 0;
      if (is_terrain == whole_robot) continue;
      // MuJoCo needs its tyres, with bits that meet nothing; Bullet takes any bit for a collider.
      const bool has_bits = GetParam() == "mujoco";
      model->mj->geom_contype[geom] = has_bits ? 4 : 0;
      model->mj->geom_conaffinity[geom] = has_bits ? 8 : 0;
    }
    const auto simulator = make_simulator(scenario, GetParam(), model);
    const logs::Recording recording = play(scenario, *simulator);
    EXPECT_EQ(recording.info.outcome, Outcome::left_terrain);
    EXPECT_LT(recording.observation.back().time, 1.0);
    EXPECT_THAT(ending_text(recording, scenario.end),
                MatchesRegex("left the terrain after 0[.][0-9]+ s: .*below the floor"));
  }
}

TEST_P(OutcomeOf, TheRecordedScenarioIsThatOfTheRun) {
  Scenario scenario = perturbed(scenario_called("push_off"), 11, 2);
  scenario.end.duration = 2.0;
  const logs::Recording first = play(scenario, GetParam());
  const logs::Recording again = play(
      scenario_from_yaml(YamlDocument::parse(first.info.scenario_yaml, "recorded")), GetParam());
  ASSERT_EQ(again.steps(), first.steps());
  EXPECT_EQ(again.info.outcome, first.info.outcome);
  EXPECT_EQ(again.truth.back().base_position, first.truth.back().base_position);
}

INSTANTIATE_TEST_SUITE_P(Engine, OutcomeOf, ::testing::ValuesIn(simulators::simulator_names()),
                         engine_name);

TEST(Outcomes, HaveTextsThatAreReadBack) {
  for (const Outcome outcome : {Outcome::finished, Outcome::timed_out, Outcome::fell,
                                Outcome::diverged, Outcome::left_terrain}) {
    EXPECT_EQ(logs::outcome_from_text(logs::to_text(outcome)), outcome);
  }
}

}  // namespace
}  // namespace touchdown::scenarios
