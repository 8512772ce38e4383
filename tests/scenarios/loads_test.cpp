#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "estimator/force/dynamic_loads.hpp"
#include "logs/signals_from.hpp"
#include "scenarios/leg_geometry.hpp"
#include "tests/scenarios/runs.hpp"

namespace touchdown::scenarios {
namespace {

/// How often the true force is within two deviations of the load, of the steps with one.
struct Coverage {
  int within = 0;
  int all = 0;
  double share() const { return static_cast<double>(within) / std::max(1, all); }
};

struct Coverages {
  Coverage carried;  ///< with more than a tenth of the robot's weight on the wheel for 20 ms
  Coverage in_air;   ///< for 20 ms
};

/// By the forces that the engine computed. Moments at edges, where the contact's normal is not
/// vertical, are few on these scenes.
Coverages coverages(const std::string& robot_file, const std::string& scene,
                    const std::string& engine) {
  Scenario scenario = scenario_called(scene);
  scenario.robot = fmt::format("{}/models/{}", TOUCHDOWN_SOURCE_DIR, robot_file);
  const logs::Recording recording = play(scenario, engine);
  const LegGeometry geometry =
      leg_geometry(models::compile_robot_model(scenario.robot, scenario.terrain));
  DynamicLoads estimates(geometry, 1.0 / recording.period());
  const double weight = 9.81 * geometry.robot_mass;
  Coverages found;
  std::array<int, 2> carried{};
  std::array<int, 2> in_air{};
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    const DynamicLoads::Loads loads = estimates.known(estimates.update(
        logs::signals_from(recording.observation[k], k > 0 ? &recording.action[k - 1] : nullptr)));
    for (std::size_t wheel = 0; wheel < 2; ++wheel) {
      const double force = recording.truth[k].wheel_normal_force[wheel];
      carried[wheel] = force > 0.1 * weight ? carried[wheel] + 1 : 0;
      in_air[wheel] = force == 0.0 ? in_air[wheel] + 1 : 0;
      if (std::max(carried[wheel], in_air[wheel]) < 20 || k < 100) continue;
      Coverage& coverage = carried[wheel] > 0 ? found.carried : found.in_air;
      if (std::isnan(loads[wheel].force)) continue;
      ++coverage.all;
      if (std::abs(loads[wheel].force - force) <= 2.0 * loads[wheel].deviation) ++coverage.within;
    }
  }
  return found;
}

void expect_covered(const std::string& robot, const std::string& scene, const std::string& engine,
                    bool flies) {
  const Coverages found = coverages(robot, scene, engine);
  const std::string of = fmt::format("{} {} {}", robot, scene, engine);
  EXPECT_GT(found.carried.all, 500) << of;
  EXPECT_GT(found.carried.share(), 0.9) << of;
  if (!flies) return;
  EXPECT_GT(found.in_air.all, 50) << of;
  EXPECT_GT(found.in_air.share(), 0.9) << of;
}

class LoadsIn : public InEveryEngine {};

TEST_P(LoadsIn, AHopAndTheStairsAreTheEnginesForces) {
  for (const char* scene : {"hop", "one_step", "push_off"}) {
    expect_covered("upkie.xml", scene, GetParam(), true);
  }
  expect_covered("upkie.xml", "squat", GetParam(), false);
}

TEST_P(LoadsIn, OtherRobotsFollowFromTheirFiles) {
  for (const char* robot : {"upkie_heavy.yaml", "upkie_long_legs.yaml", "hip_roll.yaml",
                            "knee_and_wheel.yaml", "five_bar.yaml", "four_bar.yaml"}) {
    const bool flies = std::string(robot) != "five_bar.yaml";  // it is tall
    expect_covered(robot, "one_step", GetParam(), flies);
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, LoadsIn, ::testing::ValuesIn(simulators::simulator_names()),
                         engine_name);

}  // namespace
}  // namespace touchdown::scenarios
