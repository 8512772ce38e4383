// Scenes that distinguish estimators: each contains the situation that its first lines describe.
#include <algorithm>
#include <limits>

#include "models/robot.hpp"
#include "tests/scenarios/runs.hpp"

namespace touchdown::scenarios {
namespace {

class DistinguishingScene : public InEveryEngine {
 protected:
  static logs::Recording recording_of(const char* name, int run = 0) {
    logs::Recording recording = play(perturbed(scenario_called(name), 7, run), GetParam());
    EXPECT_EQ(recording.info.outcome, logs::Outcome::finished) << name;
    return recording;
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

TEST_P(DistinguishingScene, AKerbLiftsOneWheelThenTheOther) {
  const logs::Recording recording = recording_of("kerb");
  const auto [left, right] = longest_single_flights(recording);
  EXPECT_GT(left, 0.04);
  EXPECT_GT(right, 0.04);
  EXPECT_THAT(flights(recording, 0.05), ::testing::IsEmpty());
}

TEST_P(DistinguishingScene, AKerbInACurveLiftsOneWheelLongBeforeTheOther) {
  const logs::Recording recording = recording_of("kerb_turn");
  const auto [left, right] = longest_single_flights(recording);
  EXPECT_GT(std::max(left, right), 0.1);
  EXPECT_GT(recording.observation.back().yaw - recording.observation.front().yaw, 0.8);
}

TEST_P(DistinguishingScene, WheelsLandWithASpeedOtherThanTheGrounds) {
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

TEST_P(DistinguishingScene, ASquatAcceleratesDownWithItsWheelsOnTheGround) {
  const logs::Recording recording = recording_of("squat");
  EXPECT_LT(lowest_acceleration(recording), -4.9);
  EXPECT_THAT(flights(recording, 0.02), ::testing::IsEmpty());
}

TEST_P(DistinguishingScene, ALiftByHandIsNoFreeFall) {
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

TEST_P(DistinguishingScene, ARampThrowsTheRobotUpwards) {
  const logs::Recording recording = recording_of("ramp_jump");
  EXPECT_EQ(flights(recording, 0.05).size(), 3U);
}

TEST_P(DistinguishingScene, LegsHopByThemselves) {
  EXPECT_GE(flights(recording_of("hop"), 0.03).size(), 2U);
}

TEST_P(DistinguishingScene, AWashboardUnloadsTheWheels) {
  const logs::Recording recording = recording_of("washboard");
  int light = 0;
  for (const models::GroundTruth& truth : recording.truth) {
    light += truth.wheel_normal_force[0] < 10.0 ? 1 : 0;
  }
  EXPECT_GT(light, 100);
}

TEST_P(DistinguishingScene, PushesDoNotLiftAStandingRobot) {
  const logs::Recording recording = recording_of("pushed", 1);
  EXPECT_THAT(flights(recording, 0.005), ::testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Engine, DistinguishingScene,
                         ::testing::ValuesIn(simulators::simulator_names()), engine_name);

}  // namespace
}  // namespace touchdown::scenarios
