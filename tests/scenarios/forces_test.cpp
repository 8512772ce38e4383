#include "simulators/registry.hpp"
#include "tests/scenarios/runs.hpp"

namespace touchdown::scenarios {
namespace {

constexpr double g = 9.81;
constexpr double mass = 5.33922;  // kg

double mean_load(const logs::Recording& recording, double from, double to) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    const double time = recording.observation[k].time;
    if (time < from || time >= to) continue;
    sum += recording.truth[k].wheel_normal_force[0] + recording.truth[k].wheel_normal_force[1];
    ++count;
  }
  return sum / count;
}

class ForcesOf : public InEveryEngine {};

TEST_P(ForcesOf, TheGroundCarriesTheWeightMinusAllLifts) {
  Scenario lifted = standing(6.0);
  lifted.mass_scale = 1.2;
  lifted.forces = {{.time = 2.0, .duration = 9.0, .force = {0.0, 0.0, 15.0}},  // together 20 N
                   {.time = 2.0, .duration = 9.0, .force = {0.0, 0.0, 5.0}}};
  const logs::Recording recording = play(lifted, GetParam());
  const double weight = 1.2 * mass * g;
  EXPECT_NEAR(mean_load(recording, 1.0, 2.0), weight, 1e-3 * weight);
  EXPECT_NEAR(mean_load(recording, 4.0, 6.0), weight - 20.0, 1e-3 * weight);
}

TEST_P(ForcesOf, AForceBeyondTheWeightThrowsTheRobotUpByTheSurplus) {
  Scenario thrown = standing(0.9);
  const double force = 80.0;
  thrown.forces = {{.time = 0.5, .duration = 0.3, .force = {0.0, 0.0, force}}};
  const logs::Recording recording = play(thrown, GetParam());
  // Momentum from the force minus gravity. Contact ends at once; the soft ground adds some.
  const double rise = recording.truth.back().base_linear_velocity.z();
  const double expected = (force * 0.3 / mass) - g * (0.9 - 0.5);
  EXPECT_NEAR(rise, expected, 0.15);
}

TEST_P(ForcesOf, TheTetherCarriesTheHangingRobot) {
  Scenario hung = scenario_called("hang");
  hung.end.duration = 6.0;
  hung.velocity.clear();
  const logs::Recording recording = play(hung, GetParam());
  // At rest the rope's elongation is the weight over its stiffness.
  const models::GroundTruth& end = recording.truth.back();
  const policies::Tether& tether = *hung.tether;
  const Eigen::Vector3d held = end.base_position + end.base_orientation * tether.point_in_base;
  EXPECT_NEAR((tether.anchor - held).norm() - tether.length, mass * g / tether.stiffness, 1e-4);
  EXPECT_NEAR(policies::tether_force(tether, end).norm(), mass * g, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Engine, ForcesOf, ::testing::ValuesIn(simulators::simulator_names()),
                         engine_name);

}  // namespace
}  // namespace touchdown::scenarios
