#include <algorithm>
#include <set>

#include "core/random.hpp"
#include "policies/commands.hpp"
#include "scenarios/scenario_file.hpp"
#include "tests/scenarios/runs.hpp"

namespace touchdown::scenarios {
namespace {

Perturbation all_of_it() {
  return {.x = 0.1,
          .y = 0.2,
          .yaw = 0.3,
          .velocity = 0.15,
          .crouch = 0.1,
          .mass_scale = 0.1,
          .friction = 0.3,
          .servo_gain_scale = 0.2,
          .force_scale = 0.5,
          .com_x = 0.01,
          .com_z = 0.02,
          .wheel_radius_scale = 0.03,
          .actuator_friction_scale = 0.4,
          .torque_error = 0.05,
          .drive = std::nullopt,
          .crouching = std::nullopt,
          .lift = std::nullopt};
}

Scenario base() {
  Scenario scenario = standing(20.0);
  scenario.velocity = {{1.0, 0.5, 0.0}, {3.0, 0.0, 0.0}};
  scenario.forces = {{.time = 1.0, .duration = 0.5, .force = {2.0, 0.0, 4.0}}};
  scenario.perturbation = all_of_it();
  return scenario;
}

TEST(Perturbed, IsAFunctionOfSeedAndRun) {
  EXPECT_EQ(to_yaml(perturbed(base(), 5, 3)), to_yaml(perturbed(base(), 5, 3)));
  EXPECT_NE(to_yaml(perturbed(base(), 5, 3)), to_yaml(perturbed(base(), 5, 4)));
  EXPECT_NE(to_yaml(perturbed(base(), 5, 3)), to_yaml(perturbed(base(), 6, 3)));
}

TEST(Perturbed, StaysWithinTheHalfWidthsAndReachesThem) {
  double lowest = 1e9;
  double highest = -1e9;
  for (int run = 0; run < 400; ++run) {
    const Scenario varied = perturbed(base(), 1, run);
    EXPECT_LE(std::abs(varied.start.x), 0.1);
    EXPECT_LE(std::abs(varied.start.y), 0.2);
    EXPECT_LE(std::abs(varied.start.yaw), 0.3);
    EXPECT_LE(std::abs(varied.velocity[0].velocity - 0.5), 0.15);
    EXPECT_EQ(varied.velocity[1].velocity, 0.0);  // standing stays standing
    EXPECT_LE(std::abs(varied.start.hip - 0.455), 0.1);
    EXPECT_NEAR(varied.start.knee / varied.start.hip, 0.791 / 0.455, 1e-12);
    EXPECT_LE(std::abs(varied.mass_scale - 1.0), 0.1);
    EXPECT_LE(std::abs(varied.terrain.friction - 1.0), 0.3);
    EXPECT_LE(std::abs(varied.balancer.leg_kp_scale - 2.0), 0.4);
    EXPECT_NEAR(varied.balancer.leg_kd_scale, varied.balancer.leg_kp_scale, 1e-12);
    EXPECT_LE(std::abs(varied.forces[0].force.x() - 2.0), 1.0);
    EXPECT_NEAR(varied.forces[0].force.z(), 2.0 * varied.forces[0].force.x(), 1e-12);
    const Deviations& d = varied.deviations;
    EXPECT_LE(std::abs(d.com_x), 0.01);
    EXPECT_LE(std::abs(d.com_z), 0.02);
    EXPECT_LE(std::abs(d.wheel_radius_scale - 1.0), 0.03);
    EXPECT_LE(std::abs(d.actuator_friction_scale - 1.0), 0.4);
    for (const double error : d.torque_error) EXPECT_LE(std::abs(error), 0.05);
    lowest = std::min(lowest, varied.start.x);
    highest = std::max(highest, varied.start.x);
  }
  EXPECT_LT(lowest, -0.095);
  EXPECT_GT(highest, 0.095);
}

TEST(Perturbed, AddingAQuantityChangesNoOtherDraw) {
  Scenario less = base();
  less.perturbation = {};
  less.perturbation.yaw = 0.3;
  Scenario more = base();
  more.perturbation.drive = RandomDrive{};
  more.perturbation.lift = RandomLifts{};
  for (int run = 0; run < 5; ++run) {
    const Scenario alone = perturbed(less, 9, run);
    const Scenario some = perturbed(base(), 9, run);
    const Scenario all = perturbed(more, 9, run);
    EXPECT_EQ(alone.start.yaw, some.start.yaw);
    EXPECT_EQ(alone.start.x, 0.0);
    EXPECT_EQ(some.start.yaw, all.start.yaw);
    EXPECT_EQ(some.mass_scale, all.mass_scale);
    EXPECT_EQ(some.forces[0].force, all.forces[0].force);
  }
}

TEST(Perturbed, DeviationsOfTheRobotAreIndependentAndChangeNoOtherDraw) {
  Scenario fixed = base();
  fixed.perturbation.com_x = fixed.perturbation.com_z = fixed.perturbation.torque_error = 0.0;
  fixed.perturbation.wheel_radius_scale = fixed.perturbation.actuator_friction_scale = 0.0;
  Scenario wheels = fixed;
  wheels.perturbation.wheel_radius_scale = 0.03;
  for (int run = 0; run < 5; ++run) {
    Scenario all = perturbed(base(), 9, run);
    EXPECT_EQ(perturbed(wheels, 9, run).deviations.wheel_radius_scale,
              all.deviations.wheel_radius_scale);
    const Deviations drawn = all.deviations;
    std::set<double> shares = {drawn.com_x / 0.01, drawn.com_z / 0.02};
    for (const double error : drawn.torque_error) shares.insert(error / 0.05);
    EXPECT_EQ(shares.size(), 8U);
    all.deviations = {};
    EXPECT_EQ(to_yaml(all), to_yaml(perturbed(fixed, 9, run)));
  }
  EXPECT_THAT(to_yaml(fixed), ::testing::Not(::testing::HasSubstr("com_x")))
      << "scenarios without deviations stay unchanged";
}

TEST(Perturbed, WithoutPerturbationNothingChanges) {
  Scenario still = base();
  still.perturbation = {};
  EXPECT_EQ(to_yaml(perturbed(still, 4, 2)), to_yaml(still));
}

TEST(Perturbed, APerturbedScenarioIsNotPerturbedAgain) {
  const Scenario once = perturbed(base(), 4, 2);
  EXPECT_EQ(to_yaml(perturbed(once, 8, 8)), to_yaml(once));
}

TEST(Perturbed, QuantitiesAreIndependent) {
  // The correlation of two streams over many runs is within four standard errors of zero.
  double product = 0.0;
  const int runs = 4000;
  for (int run = 0; run < runs; ++run) {
    const Scenario varied = perturbed(base(), 1, run);
    product += (varied.start.x / 0.1) * (varied.start.yaw / 0.3);
  }
  EXPECT_LT(std::abs(product / runs) * 3.0, 4.0 / std::sqrt(runs));
}

/// The knees that a run commands, from straight legs, positive where the robot's stance bends them.
std::vector<double> commanded_knees(const Scenario& scenario, const Scenario& varied) {
  const double side = scenario.start.knee < 0.0 ? -1.0 : 1.0;
  std::vector<double> knees = {side * varied.start.knee};
  for (const policies::CrouchCommand& command : varied.crouch) {
    knees.push_back(
        side * (varied.start.knee + policies::knee_per_hip * (command.hip - varied.start.hip)));
  }
  return knees;
}

const std::vector<const char*> robots_of_all_stances = {
    "upkie.xml",           "upkie_straight.yaml",  "upkie_straight_actuated.yaml",
    "upkie_actuated.yaml", "upkie_long_legs.yaml", "upkie_asymmetric.yaml"};

Scenario with_robot(const std::string& scenario, const std::string& robot) {
  YamlDocument document =
      YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/scenarios/" + scenario + ".yaml");
  document.override_value("robot=" TOUCHDOWN_SOURCE_DIR "/models/" + robot);
  return complete_scenario(document);
}

TEST(Perturbed, BendsNoKneeBackwards) {
  for (const char* name : {"roam", "hang", "kerb", "put_down", "pushed", "lift_slowly",
                           "roam_crouching", "hang_crouching"}) {
    for (const char* robot : robots_of_all_stances) {
      const Scenario scenario = with_robot(name, robot);
      double lowest = 1e9;
      for (int run = 0; run < 2000; ++run) {
        for (const double knee : commanded_knees(scenario, perturbed(scenario, 7, run))) {
          lowest = std::min(lowest, knee);
        }
      }
      EXPECT_GE(lowest, 1.7 * least_bend) << name << ' ' << robot;
    }
  }
}

class StraightRobot : public InEveryEngine {};

/// Targets are not all: servos give way, and wheels turn the legs.
TEST_P(StraightRobot, BendsNoKneeBackwardsWhileItMoves) {
  for (const char* name : {"roam", "hang", "roam_crouching", "hang_crouching"}) {
    Scenario scenario = with_robot(name, "upkie_straight_actuated.yaml");
    scenario.end.duration = 5.0;
    for (int run = 0; run < 4; ++run) {
      const logs::Recording recording = play(perturbed(scenario, 11, run), GetParam(), 11, run);
      double lowest = 1e9;
      for (const models::Observation& observation : recording.observation) {
        lowest =
            std::min({lowest, -observation.servo[models::index(models::Servo::left_knee)].position,
                      observation.servo[models::index(models::Servo::right_knee)].position});
      }
      EXPECT_GT(lowest, 0.01) << name << " run " << run;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, StraightRobot, ::testing::ValuesIn(simulators::simulator_names()),
                         engine_name);

TEST(Perturbed, BendsNoKneeBackwardsForAnyStance) {
  for (const double hip : {0.02, 0.05, 0.1, 0.3, -0.02, -0.05, -0.1, -0.3}) {
    Scenario scenario = standing(1.0);
    scenario.start.hip = hip;
    scenario.start.knee = policies::knee_per_hip * hip;
    for (const double half_width : {0.01, 0.15, 0.6}) {
      scenario.perturbation.crouch = half_width;
      for (int run = 0; run < 300; ++run) {
        const double drawn = perturbed(scenario, 1, run).start.hip;
        EXPECT_GE(drawn / hip, std::min(1.0, least_bend / std::abs(hip)))
            << hip << ' ' << half_width;
        EXPECT_LE(std::abs(drawn - hip), half_width);
      }
    }
  }
}

TEST(Perturbed, KeepsTheDrawsOfBentRobots) {
  const Scenario roam = with_robot("roam", "upkie.xml");
  for (int run = 0; run < 200; ++run) {
    const double u = uniform01(3, static_cast<std::uint64_t>(run), 4);
    EXPECT_DOUBLE_EQ(perturbed(roam, 3, run).start.hip, 0.455 + 0.15 * (2.0 * u - 1.0));
  }
}

}  // namespace
}  // namespace touchdown::scenarios
