#include "simulators/registry.hpp"
#include "tests/scenarios/runs.hpp"

namespace touchdown::scenarios {
namespace {

class OutcomeOf : public InEveryEngine {};

TEST_P(OutcomeOf, ARobotPushedOverIsAFall) {
  Scenario pushed = standing(10.0);
  pushed.forces = {{.time = 0.5, .duration = 0.5, .force = {0.0, 60.0, 0.0}}};
  const recordings::Recording recording = play(pushed, GetParam());
  EXPECT_EQ(recording.info.outcome, recordings::Outcome::fell);
  EXPECT_LT(recording.observation.back().time, 3.0);
  EXPECT_GT(recording.observation.back().time, 0.5);
}

TEST_P(OutcomeOf, ARobotThatCannotBalanceFalls) {
  Scenario limp = standing(10.0);
  limp.balancer.max_velocity = 0.0;
  limp.forces = {{.time = 0.2, .duration = 0.1, .force = {10.0, 0.0, 0.0}}};
  EXPECT_EQ(play(limp, GetParam()).info.outcome, recordings::Outcome::fell);
}

TEST_P(OutcomeOf, NotArrivingInTimeIsATimeout) {
  Scenario slow = standing(1.0);
  slow.end.x = 5.0;
  const recordings::Recording recording = play(slow, GetParam());
  EXPECT_EQ(recording.info.outcome, recordings::Outcome::timed_out);
  EXPECT_NEAR(recording.observation.back().time, 1.0, 1e-9);
  EXPECT_EQ(recording.steps(), 1001U);
}

TEST_P(OutcomeOf, WithoutFinishLineTheDurationIsTheEnd) {
  EXPECT_EQ(play(standing(0.5), GetParam()).info.outcome, recordings::Outcome::finished);
}

TEST_P(OutcomeOf, TheRunFinishesAfterTheSettlingTime) {
  Scenario driving = standing(10.0);
  driving.velocity = {{0.2, 0.5, 0.0}};
  driving.end.x = 0.5;
  driving.end.settle = 0.7;
  const recordings::Recording recording = play(driving, GetParam());
  EXPECT_EQ(recording.info.outcome, recordings::Outcome::finished);
  std::size_t passed = 0;
  while (recording.truth[passed].base_position.x() <= 0.5) ++passed;
  EXPECT_NEAR(recording.observation.back().time - recording.observation[passed].time, 0.7, 1e-6);
}

TEST_P(OutcomeOf, AnAbsurdForceIsADivergence) {
  Scenario absurd = standing(5.0);
  absurd.forces = {{.time = 0.1, .duration = 1.0, .force = {0.0, 0.0, 1e9}}};
  const recordings::Recording recording = play(absurd, GetParam());
  EXPECT_EQ(recording.info.outcome, recordings::Outcome::diverged);
  EXPECT_LT(recording.observation.back().time, 0.3);
}

TEST_P(OutcomeOf, AStoppedRunHasNoOutcome) {
  int reports = 0;
  const recordings::Recording recording = play(standing(10.0), GetParam(), 3, 4, [&](double time) {
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
  const recordings::Recording first = play(scenario, GetParam());
  const recordings::Recording again = play(
      scenario_from_yaml(YamlDocument::parse(first.info.scenario_yaml, "recorded")), GetParam());
  ASSERT_EQ(again.steps(), first.steps());
  EXPECT_EQ(again.truth.back().base_position, first.truth.back().base_position);
}

INSTANTIATE_TEST_SUITE_P(Engine, OutcomeOf, ::testing::ValuesIn(simulators::simulator_names()),
                         engine_name);

TEST(Outcome, AnUnknownEngineIsAnInputError) {
  EXPECT_THROW((void)play(standing(1.0), "gazebo"), InputError);
}

}  // namespace
}  // namespace touchdown::scenarios
