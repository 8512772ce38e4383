#include "simulators/registry.hpp"
#include "tests/scenarios/runs.hpp"

namespace touchdown::scenarios {
namespace {

class ScenarioFile : public InEveryEngine {};

TEST_P(ScenarioFile, StairsGiveSevenFlights) {
  const Scenario stairs = scenario_called("stairs");
  for (int run = 0; run < 8; ++run) {
    const logs::Recording recording = play(perturbed(stairs, 7, run), GetParam(), 7, run);
    EXPECT_EQ(recording.info.outcome, logs::Outcome::finished) << "run " << run;
    EXPECT_EQ(flights(recording, 0.05).size(), 7U) << "run " << run;
    EXPECT_GT(recording.truth.back().base_position.x(), stairs.end.x);
  }
}

TEST_P(ScenarioFile, TheAuthorsStairsEndInALongerFlight) {
  const logs::Recording recording =
      play(perturbed(scenario_called("stairs_authors"), 7, 0), GetParam(), 7, 0);
  EXPECT_EQ(recording.info.outcome, logs::Outcome::finished);
  const std::vector<double> durations = flights(recording, 0.05);
  ASSERT_EQ(durations.size(), 7U);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_LT(durations[i], durations[6] - 0.02);
}

TEST_P(ScenarioFile, TheCourseGivesTenFlightsInFiveLaps) {
  const logs::Recording recording =
      play(perturbed(scenario_called("course"), 7, 0), GetParam(), 7, 0);
  EXPECT_EQ(recording.info.outcome, logs::Outcome::finished);
  const std::vector<double> durations = flights(recording, 0.02);
  ASSERT_EQ(durations.size(), 10U);
  for (std::size_t i = 0; i < 10; i += 2) {  // a small drop, a large one
    EXPECT_LT(durations[i], 0.09) << i;
    EXPECT_GT(durations[i + 1], 0.09) << i;
    EXPECT_LT(durations[i + 1], 0.17) << i;
  }
}

TEST_P(ScenarioFile, HangingIsNeverContact) {
  for (int run = 0; run < 2; ++run) {
    const logs::Recording recording = play(perturbed(scenario_called("hang"), 7, run), GetParam());
    EXPECT_EQ(recording.info.outcome, logs::Outcome::finished);
    for (const models::GroundTruth& truth : recording.truth) {
      ASSERT_EQ(truth.wheel_normal_force, (std::array<double, 2>{0.0, 0.0}));
    }
  }
}

/// Both wheels on the ground, from 0.3 s to the end.
void expect_contact(const logs::Recording& recording, double longest_gap) {
  EXPECT_EQ(recording.info.outcome, logs::Outcome::finished);
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    double gap = 0.0;
    for (std::size_t k = 0; k < recording.steps(); ++k) {
      if (recording.observation[k].time < 0.3) continue;
      gap = in_contact(recording.truth[k], wheel) ? 0.0 : gap + recording.period();
      ASSERT_LE(gap, longest_gap) << "at " << recording.observation[k].time << " s";
    }
  }
}

TEST_P(ScenarioFile, StandingIsAlwaysContact) {
  expect_contact(play(standing(5.0), GetParam()), 0.0);
}

TEST_P(ScenarioFile, DrivingOnTheFlatIsAlwaysContact) {
  expect_contact(play(perturbed(scenario_called("flat"), 7, 0), GetParam()), 0.0);
}

TEST_P(ScenarioFile, RoamingIsAlwaysContact) {
  for (int run = 0; run < 3; ++run) {
    expect_contact(play(perturbed(scenario_called("roam"), 7, run), GetParam()), 0.0);
  }
}

/// Five seconds of a scenario, with Upkie's real actuators.
Scenario crouching(const std::string& name, int run) {
  Scenario scenario = scenario_called(name);
  scenario.robot = TOUCHDOWN_SOURCE_DIR "/models/upkie_actuated.yaml";
  scenario.end.duration = 5.0;
  return perturbed(scenario, 7, run);
}

TEST_P(ScenarioFile, RoamingAndCrouchingStaysUprightAndInContact) {
  for (int run = 0; run < 2; ++run) {
    const Scenario scenario = crouching("roam_crouching", run);
    const logs::Recording recording = play(scenario, GetParam());
    expect_contact(recording, 0.0);
    // At the end the hip is at its last command, if there was time to reach it.
    const policies::CrouchCommand& last = *policies::crouch_at(scenario.crouch, 5.0);
    if (last.time > 3.0) continue;
    const std::size_t hip = models::index(models::Servo::left_hip);
    EXPECT_NEAR(recording.observation.back().servo[hip].position, last.hip, 0.05);
  }
}

TEST_P(ScenarioFile, HangingAndCrouchingIsNeverContact) {
  const logs::Recording recording = play(crouching("hang_crouching", 0), GetParam());
  EXPECT_EQ(recording.info.outcome, logs::Outcome::finished);
  for (const models::GroundTruth& truth : recording.truth) {
    ASSERT_EQ(truth.wheel_normal_force, (std::array<double, 2>{0.0, 0.0}));
  }
}

TEST_P(ScenarioFile, WhenPushedOffAskewOneWheelLeavesFirst) {
  Scenario askew = scenario_called("push_off");
  askew.start.yaw = 0.5;
  const logs::Recording recording = play(askew, GetParam());
  EXPECT_EQ(recording.info.outcome, logs::Outcome::finished);
  EXPECT_EQ(flights(recording, 0.05).size(), 1U);
  // The robot heads left, so the right wheel reaches the edge first.
  int right_alone_off = 0;
  for (std::size_t k = 1; k < recording.steps(); ++k) {
    const models::GroundTruth& truth = recording.truth[k];
    if (!in_contact(truth, 0) && !in_contact(truth, 1)) break;
    right_alone_off += in_contact(truth, 0) && !in_contact(truth, 1) ? 1 : 0;
  }
  EXPECT_GT(right_alone_off, 20);  // ms
}

TEST_P(ScenarioFile, LiftingTakesTheRobotOffTheFloorAndPutsItBack) {
  const logs::Recording recording = play(perturbed(scenario_called("lift"), 7, 0), GetParam());
  EXPECT_EQ(recording.info.outcome, logs::Outcome::finished);
  EXPECT_EQ(recording.period(), 0.005);
  EXPECT_GE(flights(recording, 0.1).size(), 4U);
  EXPECT_TRUE(in_contact(recording.truth.back(), 0));
}

TEST_P(ScenarioFile, TheSameRunGivesTheSameBits) {
  const Scenario run = perturbed(scenario_called("stairs"), 7, 1);
  const auto simulator = make_simulator(run, GetParam());
  const logs::Recording first = play(run, GetParam());
  for (const logs::Recording& again :
       {play(run, GetParam()), play(run, *simulator), play(run, *simulator)}) {
    EXPECT_EQ(again.info.outcome, first.info.outcome);
    ASSERT_EQ(again.steps(), first.steps());
    for (std::size_t k = 0; k < first.steps(); ++k) {
      const models::Observation& a = again.observation[k];
      const models::Observation& b = first.observation[k];
      ASSERT_EQ(a.time, b.time);
      ASSERT_EQ(a.imu.raw_linear_acceleration, b.imu.raw_linear_acceleration);
      ASSERT_EQ(a.imu.orientation.coeffs(), b.imu.orientation.coeffs());
      ASSERT_EQ(again.truth[k].base_position, first.truth[k].base_position);
      ASSERT_EQ(again.truth[k].wheel_normal_force, first.truth[k].wheel_normal_force);
      for (std::size_t i = 0; i < models::servo_count; ++i) {
        ASSERT_EQ(a.servo[i].torque, b.servo[i].torque);
        ASSERT_EQ(a.servo[i].velocity, b.servo[i].velocity);
        ASSERT_EQ(again.action[k].servo[i].velocity, first.action[k].servo[i].velocity);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Engine, ScenarioFile, ::testing::ValuesIn(simulators::simulator_names()),
                         engine_name);

}  // namespace
}  // namespace touchdown::scenarios
