#include "tests/scenarios/runs.hpp"

namespace touchdown::scenarios {
namespace {

/// Measurements of a drop from one stair.
struct Drop {
  std::vector<double> flights;  ///< s
  double peak = 0.0;            ///< largest vertical acceleration (m/s²)
};

Drop drop_of(const std::string& robot, const std::string& engine) {
  Scenario stair = standing(3.0);
  stair.robot = TOUCHDOWN_SOURCE_DIR "/models/" + robot;
  stair.terrain.start_x = -1.0;
  stair.terrain.pieces = {models::Flat{1.6}, models::StairFlight{.count = 1, .run = 3.0}};
  stair.velocity = {{.time = 0.3, .velocity = 0.6}};
  const recordings::Recording recording = play(stair, engine);
  EXPECT_EQ(recording.info.outcome, recordings::Outcome::finished);
  Drop drop{.flights = flights(recording, 0.02)};
  for (const models::Observation& observation : recording.observation) {
    drop.peak = std::max(drop.peak, models::vertical_acceleration(observation.imu));
  }
  return drop;
}

TEST(RubberTyres, MakeTheSameFlightsAndLandingsInBothEngines) {
  const Drop mujoco = drop_of("upkie_rubber.yaml", "mujoco");
  const Drop bullet = drop_of("upkie_rubber.yaml", "bullet");
  ASSERT_FALSE(mujoco.flights.empty());
  ASSERT_EQ(mujoco.flights.size(), bullet.flights.size());
  EXPECT_NEAR(mujoco.flights[0], bullet.flights[0], 0.01);
  EXPECT_NEAR(mujoco.peak, bullet.peak, 0.05 * bullet.peak);
  EXPECT_GT(drop_of("upkie.xml", "bullet").peak, 1.2 * drop_of("upkie.xml", "mujoco").peak)
      << "the engines' own contacts differ more";
}

}  // namespace
}  // namespace touchdown::scenarios
