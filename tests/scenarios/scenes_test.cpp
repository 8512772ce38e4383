// The shipped scenarios contain the situations that their first lines describe.
#include <algorithm>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulators/registry.hpp"
#include "tests/scenarios/runs.hpp"

namespace touchdown::scenarios {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class Scene : public InEveryEngine {
 protected:
  static logs::Recording recording_of(const char* name, int run = 0) {
    return recording_of(perturbed(scenario_called(name), 7, run));
  }
  static logs::Recording recording_of(const Scenario& scenario) {
    logs::Recording recording = play(scenario, GetParam());
    EXPECT_EQ(recording.info.outcome, logs::Outcome::finished) << scenario.name;
    return recording;
  }

  /// Five seconds of a scenario, with Upkie's real actuators.
  static Scenario crouching(const char* name, int run) {
    Scenario scenario = scenario_called(name);
    scenario.robot = TOUCHDOWN_SOURCE_DIR "/models/upkie_actuated.yaml";
    scenario.end.duration = 5.0;
    return perturbed(scenario, 7, run);
  }

  /// For each wheel, the longest time (s) that it alone is in the air.
  static std::array<double, 2> longest_single_flights(const logs::Recording& recording) {
    std::array<double, 2> longest = {};
    std::array<double, 2> now = {};
    for (const models::GroundTruth& truth : recording.truth) {
      for (std::size_t wheel = 0; wheel < 2; ++wheel) {
        const bool alone = !in_contact(truth, wheel) && in_contact(truth, 1 - wheel);
        now[wheel] = alone ? now[wheel] + recording.period() : 0.0;
        longest[wheel] = std::max(longest[wheel], now[wheel]);
      }
    }
    return longest;
  }

  static double lowest_acceleration(const logs::Recording& recording) {
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 300; k < recording.steps(); ++k) {
      lowest = std::min(lowest, models::vertical_acceleration(recording.observation[k].imu));
    }
    return lowest;
  }
};

TEST_P(Scene, StairsGiveSevenFlights) {
  const Scenario stairs = scenario_called("stairs");
  for (int run = 0; run < 8; ++run) {
    const logs::Recording recording = play(perturbed(stairs, 7, run), GetParam(), 7, run);
    EXPECT_EQ(recording.info.outcome, logs::Outcome::finished) << "run " << run;
    EXPECT_EQ(flights(recording, 0.05).size(), 7U) << "run " << run;
    EXPECT_GT(recording.truth.back().base_position.x(), stairs.end.x);
  }
}

TEST_P(Scene, WhenPushedOffAskewOneWheelLeavesFirst) {
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

TEST_P(Scene, TheSameRunGivesTheSameBits) {
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

TEST_P(Scene, TheAuthorsStairsEndInALongerFlight) {
  const std::vector<double> durations = flights(recording_of("stairs_authors"), 0.05);
  ASSERT_THAT(durations, SizeIs(7));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_LT(durations[i], durations[6] - 0.02);
}

TEST_P(Scene, TheCourseGivesTenFlightsInFiveLaps) {
  const std::vector<double> durations = flights(recording_of("course"), 0.02);
  ASSERT_THAT(durations, SizeIs(10));
  for (std::size_t i = 0; i < 10; i += 2) {  // a small drop, a large one
    EXPECT_LT(durations[i], 0.09) << i;
    EXPECT_GT(durations[i + 1], 0.09) << i;
    EXPECT_LT(durations[i + 1], 0.17) << i;
  }
}

TEST_P(Scene, HangingIsNeverContact) {
  for (const logs::Recording& recording : {recording_of("hang", 0), recording_of("hang", 1),
                                           recording_of(crouching("hang_crouching", 0))}) {
    for (const models::GroundTruth& truth : recording.truth) {
      ASSERT_EQ(truth.wheel_normal_force, (std::array<double, 2>{0.0, 0.0}));
    }
  }
}

TEST_P(Scene, StandingDrivingAndRoamingAreAlwaysContact) {
  for (const logs::Recording& recording :
       {recording_of(standing(5.0)), recording_of("flat"), recording_of("roam", 0),
        recording_of("roam", 1), recording_of("roam", 2),
        recording_of(crouching("roam_crouching", 0)),
        recording_of(crouching("roam_crouching", 1))}) {
    for (std::size_t k = 0; k < recording.steps(); ++k) {
      if (recording.observation[k].time < 0.3) continue;
      ASSERT_TRUE(in_contact(recording.truth[k], 0) && in_contact(recording.truth[k], 1))
          << recording.info.scenario << " at " << recording.observation[k].time << " s";
    }
  }
}

TEST_P(Scene, CrouchingReachesItsLastCommand) {
  int reached = 0;
  for (int run = 0; run < 4; ++run) {
    const Scenario scenario = crouching("roam_crouching", run);
    const policies::CrouchCommand& last = *policies::crouch_at(scenario.crouch, 5.0);
    if (last.time > 3.0) continue;  // there is no time to reach it
    const std::size_t hip = models::index(models::Servo::left_hip);
    EXPECT_NEAR(recording_of(scenario).observation.back().servo[hip].position, last.hip, 0.05);
    ++reached;
  }
  EXPECT_GT(reached, 0);
}

TEST_P(Scene, LiftingTakesTheRobotOffTheFloorAndPutsItBack) {
  const logs::Recording recording = recording_of("lift");
  EXPECT_EQ(recording.period(), 0.005);
  EXPECT_GE(flights(recording, 0.1).size(), 4U);
  EXPECT_TRUE(in_contact(recording.truth.back(), 0));
}

TEST_P(Scene, AKerbLiftsOneWheelThenTheOther) {
  const logs::Recording recording = recording_of("kerb");
  const auto [left, right] = longest_single_flights(recording);
  EXPECT_GT(left, 0.04);
  EXPECT_GT(right, 0.04);
  EXPECT_THAT(flights(recording, 0.05), IsEmpty());
}

TEST_P(Scene, AKerbInACurveLiftsOneWheelLongBeforeTheOther) {
  const logs::Recording recording = recording_of("kerb_turn");
  const auto [left, right] = longest_single_flights(recording);
  EXPECT_GT(std::max(left, right), 0.1);
  EXPECT_GT(recording.observation.back().yaw - recording.observation.front().yaw, 0.8);
}

TEST_P(Scene, WheelsLandWithASpeedOtherThanTheGrounds) {
  const logs::Recording recording = recording_of("put_down");
  const double radius = 0.05;  // m
  int spinning = 0;
  for (std::size_t k = 1000; k < recording.steps(); ++k) {
    if (!in_contact(recording.truth[k], 0) || in_contact(recording.truth[k - 1], 0)) continue;
    const double rim =
        radius *
        recording.observation[k - 1].servo[models::index(models::Servo::left_wheel)].velocity;
    const double ground = recording.truth[k].base_linear_velocity.head<2>().norm();
    spinning += std::abs(std::abs(rim) - ground) > 0.25 ? 1 : 0;
  }
  EXPECT_GE(spinning, 2);
}

TEST_P(Scene, ASquatAcceleratesDownWithItsWheelsOnTheGround) {
  const logs::Recording recording = recording_of("squat");
  EXPECT_LT(lowest_acceleration(recording), -4.9);
  EXPECT_THAT(flights(recording, 0.02), IsEmpty());
}

TEST_P(Scene, ALiftByHandIsNoFreeFall) {
  const logs::Recording recording = recording_of("lift_slowly");
  const std::vector<double> durations = flights(recording, 0.2);
  EXPECT_GE(durations.size(), 4U);
  // Most of the time in the air, the robot is not in free fall.
  int in_the_air = 0;
  int falling = 0;
  for (std::size_t k = 300; k < recording.steps(); ++k) {
    if (in_contact(recording.truth[k], 0) || in_contact(recording.truth[k], 1)) continue;
    ++in_the_air;
    falling += models::vertical_acceleration(recording.observation[k].imu) < -4.9 ? 1 : 0;
  }
  EXPECT_LT(falling, in_the_air / 2);
}

TEST_P(Scene, ARampThrowsTheRobotUpwards) {
  const logs::Recording recording = recording_of("ramp_jump");
  EXPECT_EQ(flights(recording, 0.05).size(), 3U);
}

TEST_P(Scene, LegsHopByThemselves) { EXPECT_GE(flights(recording_of("hop"), 0.03).size(), 2U); }

TEST_P(Scene, AWashboardUnloadsTheWheels) {
  const logs::Recording recording = recording_of("washboard");
  int light = 0;
  for (const models::GroundTruth& truth : recording.truth) {
    light += truth.wheel_normal_force[0] < 10.0 ? 1 : 0;
  }
  EXPECT_GT(light, 100);
}

TEST_P(Scene, PushesDoNotLiftAStandingRobot) {
  const logs::Recording recording = recording_of("pushed", 1);
  EXPECT_THAT(flights(recording, 0.005), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Engine, Scene, ::testing::ValuesIn(simulators::simulator_names()),
                         engine_name);

}  // namespace
}  // namespace touchdown::scenarios
