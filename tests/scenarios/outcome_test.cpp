#include <algorithm>

#include "scenarios/engine.hpp"
#include "scenarios/scenario.hpp"
#include "simulators/registry.hpp"
#include "tests/scenarios/runs.hpp"

namespace touchdown::scenarios {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

class OutcomeOf : public InEveryEngine {};

TEST_P(OutcomeOf, ARobotPushedOverIsAFall) {
  Scenario pushed = standing(10.0);
  pushed.forces = {{.time = 0.5, .duration = 0.5, .force = {0.0, 60.0, 0.0}}};
  const logs::Recording recording = play(pushed, GetParam());
  EXPECT_EQ(recording.info.outcome, logs::Outcome::fell);
  EXPECT_LT(recording.observation.back().time, 3.0);
  EXPECT_GT(recording.observation.back().time, 0.5);
}

TEST_P(OutcomeOf, ARobotThatCannotBalanceFalls) {
  Scenario limp = standing(10.0);
  limp.balancer.max_velocity = 0.0;
  limp.forces = {{.time = 0.2, .duration = 0.1, .force = {10.0, 0.0, 0.0}}};
  EXPECT_EQ(play(limp, GetParam()).info.outcome, logs::Outcome::fell);
}

TEST_P(OutcomeOf, NotArrivingInTimeIsATimeout) {
  Scenario slow = standing(1.0);
  slow.end.x = 5.0;
  const logs::Recording recording = play(slow, GetParam());
  EXPECT_EQ(recording.info.outcome, logs::Outcome::timed_out);
  EXPECT_NEAR(recording.observation.back().time, 1.0, 1e-9);
  EXPECT_EQ(recording.steps(), 1001U);
}

TEST_P(OutcomeOf, WithoutFinishLineTheDurationIsTheEnd) {
  EXPECT_EQ(play(standing(0.5), GetParam()).info.outcome, logs::Outcome::finished);
}

TEST_P(OutcomeOf, TheRunFinishesAfterTheSettlingTime) {
  Scenario driving = standing(10.0);
  driving.velocity = {{0.2, 0.5, 0.0}};
  driving.end.x = 0.5;
  driving.end.settle = 0.7;
  const logs::Recording recording = play(driving, GetParam());
  EXPECT_EQ(recording.info.outcome, logs::Outcome::finished);
  std::size_t passed = 0;
  while (recording.truth[passed].base_position.x() <= 0.5) ++passed;
  EXPECT_NEAR(recording.observation.back().time - recording.observation[passed].time, 0.7, 1e-6);
}

TEST_P(OutcomeOf, AnAbsurdForceIsADivergence) {
  Scenario absurd = standing(5.0);
  absurd.forces = {{.time = 0.1, .duration = 1.0, .force = {0.0, 0.0, 1e9}}};
  const logs::Recording recording = play(absurd, GetParam());
  EXPECT_EQ(recording.info.outcome, logs::Outcome::diverged);
  EXPECT_LT(recording.observation.back().time, 0.3);
}

TEST_P(OutcomeOf, AStoppedRunHasNoOutcome) {
  int reports = 0;
  const logs::Recording recording = play(standing(10.0), GetParam(), 3, 4, [&](double time) {
    ++reports;
    return time < 1.0;
  });
  EXPECT_EQ(recording.info.outcome, std::nullopt);
  EXPECT_EQ(recording.info.seed, 3U);
  EXPECT_EQ(recording.info.run, 4);
  EXPECT_GT(reports, 2);
  EXPECT_LT(recording.observation.back().time, 1.5);
}

TEST_P(OutcomeOf, TheRecordedScenarioRepeatsTheRun) {
  Scenario scenario = perturbed(scenario_called("push_off"), 11, 2);
  scenario.end.duration = 2.0;
  const logs::Recording first = play(scenario, GetParam());
  const logs::Recording again = play(
      scenario_from_yaml(YamlDocument::parse(first.info.scenario_yaml, "recorded")), GetParam());
  ASSERT_EQ(again.steps(), first.steps());
  EXPECT_EQ(again.truth.back().base_position, first.truth.back().base_position);
}

INSTANTIATE_TEST_SUITE_P(Engine, OutcomeOf, ::testing::ValuesIn(simulators::simulator_names()),
                         engine_name);

TEST(Outcome, AnUnknownEngineIsAnInputError) {
  EXPECT_THROW((void)play(standing(1.0), "gazebo"), InputError);
}

class Ending : public InEveryEngine {
 protected:
  static std::string of(const Scenario& scenario) {
    return ending_text(play(scenario, GetParam()), scenario.end);
  }
};

TEST_P(Ending, OfAFinishedRunIsItsTime) { EXPECT_EQ(of(standing(0.5)), "finished after 0.501 s"); }

TEST_P(Ending, OfAFallNamesTheAngle) {
  Scenario pushed = standing(10.0);
  pushed.forces = {{.time = 0.5, .duration = 0.5, .force = {0.0, 60.0, 0.0}}};
  EXPECT_THAT(of(pushed), MatchesRegex("fell after [0-9.]+ s: roll beyond 1 rad"));
  Scenario limp = standing(10.0);
  limp.balancer.max_velocity = 0.0;
  limp.forces = {{.time = 0.2, .duration = 0.1, .force = {10.0, 0.0, 0.0}}};
  EXPECT_THAT(of(limp), MatchesRegex("fell after [0-9.]+ s: pitch beyond 1 rad"));
  limp.end.fall_tilt = 0.25;
  EXPECT_THAT(of(limp), MatchesRegex("fell after [0-9.]+ s: pitch beyond 0.25 rad"));
}

TEST_P(Ending, OfAFallOnAPartNamesTheTouch) {
  Scenario limp = standing(10.0);
  limp.balancer.leg_kp_scale = limp.balancer.leg_kd_scale = 0.0;  // the legs fold
  limp.end.fall_tilt = 3.0;
  EXPECT_THAT(of(limp), MatchesRegex("fell after [0-9.]+ s: a part other than a tyre touched .*"));
}

TEST_P(Ending, OfALateRunNamesPlaceAndFinishLine) {
  Scenario slow = standing(1.0);
  slow.end.x = 5.0;
  EXPECT_THAT(of(slow), AllOf(StartsWith("timed out after 1.001 s: at x = "),
                              HasSubstr("before the finish line at 5 m")));
}

TEST_P(Ending, OfADivergedRunIsNamed) {
  Scenario absurd = standing(5.0);
  absurd.forces = {{.time = 0.1, .duration = 1.0, .force = {0.0, 0.0, 1e9}}};
  EXPECT_THAT(of(absurd), MatchesRegex("diverged after [0-9.]+ s: .*"));
}

/// Robots that meet no ground: without tyres' bits, without any bits, or dropped through a hole.
TEST_P(Ending, OfARobotThatFallsThroughTheGroundIsNoRun) {
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
    EXPECT_EQ(recording.info.outcome, logs::Outcome::left_terrain);
    EXPECT_LT(recording.observation.back().time, 1.0);
    EXPECT_THAT(ending_text(recording, scenario.end),
                MatchesRegex("left the terrain after 0[.][0-9]+ s: .*below the floor"));
  }
}

TEST_P(Ending, OfAStoppedRunIsNoOutcome) {
  const Scenario scenario = standing(5.0);
  const logs::Recording recording =
      play(scenario, GetParam(), 0, 0, [](double time) { return time < 1.0; });
  EXPECT_THAT(ending_text(recording, scenario.end), StartsWith("stopped after 1"));
}

INSTANTIATE_TEST_SUITE_P(Engine, Ending, ::testing::ValuesIn(simulators::simulator_names()),
                         engine_name);

TEST(Outcomes, HaveTextsThatAreReadBack) {
  for (const auto outcome : {logs::Outcome::finished, logs::Outcome::timed_out, logs::Outcome::fell,
                             logs::Outcome::diverged, logs::Outcome::left_terrain}) {
    EXPECT_EQ(logs::outcome_from_text(logs::to_text(outcome)), outcome);
  }
}

}  // namespace
}  // namespace touchdown::scenarios
