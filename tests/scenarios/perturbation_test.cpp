#include <algorithm>
#include <set>

#include "core/random.hpp"
#include "policies/commands.hpp"
#include "scenarios/scenario_file.hpp"
#include "tests/draws.hpp"
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
  Scenario still = base();
  still.perturbation = {};
  EXPECT_EQ(to_yaml(perturbed(still, 4, 2)), to_yaml(still));
  const Scenario once = perturbed(base(), 4, 2);
  EXPECT_EQ(to_yaml(perturbed(once, 8, 8)), to_yaml(once)) << "it is not perturbed again";
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
  Scenario wheels = base();
  wheels.perturbation = {};
  wheels.perturbation.wheel_radius_scale = 0.03;
  Scenario more = base();
  more.perturbation.crouching = RandomCrouches{};
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
    // The errors of the robot are drawn independently, too.
    EXPECT_EQ(perturbed(wheels, 9, run).deviations.wheel_radius_scale,
              some.deviations.wheel_radius_scale);
    std::set<double> shares = {some.deviations.com_x / 0.01, some.deviations.com_z / 0.02};
    for (const double error : some.deviations.torque_error) shares.insert(error / 0.05);
    EXPECT_EQ(shares.size(), 8U);
  }
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
      for (int run = 0; run < draws(2000); ++run) {
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

const RandomDrive drive = {
    .velocity = 0.6, .yaw_rate = 0.8, .standing = 0.25, .hold = {0.5, 2.0}, .start = 1.0};

TEST(RandomDrive, HoldsEachCommandWithinItsRange) {
  int commands = 0;
  int standing = 0;
  for (int run = 0; run < 50; ++run) {
    const policies::VelocityScript script = random_drive(drive, 60.0, 3, run);
    ASSERT_FALSE(script.empty());
    EXPECT_EQ(script.front().time, 1.0);
    for (std::size_t i = 0; i < script.size(); ++i) {
      EXPECT_LE(std::abs(script[i].velocity), 0.6);
      EXPECT_LE(std::abs(script[i].yaw_rate), 0.8);
      EXPECT_LT(script[i].time, 60.0);
      if (i > 0) {
        EXPECT_GE(script[i].time - script[i - 1].time, 0.5);
        EXPECT_LE(script[i].time - script[i - 1].time, 2.0);
      }
      ++commands;
      standing += script[i].velocity == 0.0 && script[i].yaw_rate == 0.0 ? 1 : 0;
    }
    EXPECT_GT(script.back().time, 58.0);
  }
  EXPECT_NEAR(static_cast<double>(standing) / commands, 0.25, 0.04);
}

TEST(RandomLifts, LiftAndPauseWithinTheirRanges) {
  const RandomLifts lifts;
  const policies::ForceScript script = random_lifts(lifts, 60.0, 3, 1);
  ASSERT_GT(script.size(), 20U);
  for (std::size_t i = 0; i < script.size(); ++i) {
    EXPECT_EQ(script[i].force.head<2>(), Eigen::Vector2d::Zero());
    EXPECT_GE(script[i].force.z(), lifts.force.low);
    EXPECT_LE(script[i].force.z(), lifts.force.high);
    EXPECT_GE(script[i].duration, lifts.hold.low);
    EXPECT_LE(script[i].duration, lifts.hold.high);
    if (i == 0) continue;
    const double pause = script[i].time - script[i - 1].time - script[i - 1].duration;
    EXPECT_GE(pause, lifts.pause.low - 1e-12);
    EXPECT_LE(pause, lifts.pause.high + 1e-12);
  }
}

const RandomCrouches crouches = {
    .hip = {-0.05, 0.27}, .exponent = 1.35, .hold = {2.0, 6.0}, .rate = 0.3, .start = 0.5};

TEST(RandomCrouches, HoldEachHeightWithinItsRange) {
  int commands = 0;
  double mean = 0.0;
  for (int run = 0; run < 200; ++run) {
    const policies::CrouchScript script = random_crouches(crouches, 60.0, 3, run);
    ASSERT_FALSE(script.empty());
    EXPECT_EQ(script.front().time, 0.5);
    EXPECT_GT(script.back().time, 54.0);
    for (std::size_t i = 0; i < script.size(); ++i) {
      EXPECT_GE(script[i].hip, -0.05);
      EXPECT_LE(script[i].hip, 0.27);
      EXPECT_EQ(script[i].rate, 0.3);
      if (i > 0) {
        EXPECT_GE(script[i].time - script[i - 1].time, 2.0);
        EXPECT_LE(script[i].time - script[i - 1].time, 6.0);
      }
      ++commands;
      mean += script[i].hip;
    }
  }
  EXPECT_NEAR(mean / commands, -0.05 + 0.32 / 2.35, 0.005);  // the mean of U^1.35 is 1/2.35
}

TEST(RandomScripts, ReplaceTheVelocitiesAndAddToTheForces) {
  Scenario scenario = standing(10.0);
  scenario.velocity = {{1.0, 0.5, 0.0}};
  scenario.forces = {{.time = 0.5, .duration = 0.1, .force = {1.0, 0.0, 0.0}}};
  scenario.perturbation.drive = drive;
  scenario.perturbation.lift = RandomLifts{};
  const Scenario varied = perturbed(scenario, 3, 1);
  EXPECT_GT(varied.velocity.size(), 3U);
  EXPECT_GT(varied.forces.size(), 3U);
  EXPECT_EQ(varied.forces.front().force.x(), 1.0);
}

template <typename Draw>
void expect_longer_script_to_begin_the_same(const Draw& draw) {
  const auto one = draw(20.0, 3, 1);
  const auto longer = draw(40.0, 3, 1);
  ASSERT_GT(longer.size(), one.size());
  EXPECT_TRUE(std::equal(one.begin(), one.end(), longer.begin()));
  EXPECT_NE(one[0], draw(20.0, 3, 2)[0]);
  EXPECT_NE(one[0], draw(20.0, 4, 1)[0]);
}

TEST(RandomScripts, DependOnSeedAndRunOnlyAndALongerOneBeginsTheSame) {
  expect_longer_script_to_begin_the_same([](double duration, std::uint64_t seed, int run) {
    std::vector<std::array<double, 2>> script;
    for (const auto& one : random_drive(drive, duration, seed, run)) {
      script.push_back({one.time, one.velocity});
    }
    return script;
  });
  expect_longer_script_to_begin_the_same([](double duration, std::uint64_t seed, int run) {
    std::vector<std::array<double, 2>> script;
    for (const auto& one : random_crouches(crouches, duration, seed, run)) {
      script.push_back({one.time, one.hip});
    }
    return script;
  });
}

}  // namespace
}  // namespace touchdown::scenarios
