#include <algorithm>
#include <cmath>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "core/resources.hpp"
#include "logs/log/recording_file.hpp"
#include "policies/wheeled_pendulum.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/robot_check.hpp"
#include "scenarios/scenario_file.hpp"
#include "scenarios/start_pose.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scenarios/runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::scenarios {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Every robot file of the project, MJCF files included.
std::vector<std::string> robots() {
  std::vector<std::string> files;
  for (const char* extension : {".yaml", ".xml"}) {
    for (const auto& file : resources_in("models", extension)) files.push_back(file.string());
  }
  return files;
}

using RobotAndEngine = std::tuple<std::string, std::string>;

class Robot : public ::testing::TestWithParam<RobotAndEngine> {
 protected:
  static Scenario of_this_robot(const std::string& scenario) {
    YamlDocument document = YamlDocument::load(find_resource("scenarios/" + scenario + ".yaml"));
    document.override_value("robot=" + std::get<0>(GetParam()));
    return complete_scenario(document);
  }
  static std::string engine() { return std::get<1>(GetParam()); }
};

TEST_P(Robot, ComesDownAStep) {
  Scenario scenario = of_this_robot("one_step");
  scenario.start.x = 2.3;
  scenario.velocity.front().time = 0.1;
  scenario.end.settle = 0.3;
  const logs::Recording recording = play(scenario, engine());
  EXPECT_EQ(recording.info.outcome, logs::Outcome::finished);
  EXPECT_GE(flights(recording, 0.1).size(), 1U);
}

TEST_P(Robot, IsLiftedOffTheGroundForAnyMass) {
  Scenario scenario = of_this_robot("lift_slowly");
  scenario.end.duration = 2.5;
  const logs::Recording recording = play(perturbed(scenario, 7, 0), engine());
  EXPECT_GE(flights(recording, 0.1).size(), 1U);
}

/// Sums both equations of motion, so that the wheels' torques cancel, over an interval with wheel
/// torque: D·Δθ̇ + (C/r)·Δṡ = G·∫θ.
TEST_P(Robot, MovesLikeThePendulumOfItsGains) {
  Scenario scenario = of_this_robot("one_step");
  scenario.terrain = {};
  scenario.simulation.contact.rolling_resistance = 0.0;
  scenario.robot = find_resource(scenario.robot);
  const auto model = std::make_shared<models::RobotModel>(compile_robot(scenario));
  model->actuator = {};  // ideal: the joints get the commanded torques
  const auto simulator = make_simulator(scenario, engine(), model);
  const simulators::RobotState start = start_pose(*model, scenario.terrain, scenario.start);
  const policies::WheeledPendulum pendulum =
      policies::wheeled_pendulum(*model, start.orientation, start.joint_position);
  simulator->reset(start);
  // Stiff legs: the pendulum's do not bend. Weight and length of a leg bend it more, and legs that
  // are not symmetric bend to one side.
  constexpr double upkie_gravity = 19.2;  // N·m per rad of lean
  const double sideways = std::abs(pendulum.bending) / pendulum.gravity / 0.03;
  const double stiffness =
      20.0 * std::max({1.0, std::pow(pendulum.gravity / upkie_gravity, 2), sideways});
  models::Action action;
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    action.servo[i] = {.position = start.joint_position[i], .kp_scale = stiffness, .kd_scale = 2.0};
  }
  const double upright = simulator->observation().pitch;
  const auto rolled = [&] {
    const auto& servo = simulator->state().joint_velocity;
    return 0.5 * model->wheel_radius *
           (servo[models::index(models::Servo::left_wheel)] -
            servo[models::index(models::Servo::right_wheel)]);
  };
  double leaned = 0.0;
  for (const auto& [torque, steps] : {std::pair{0.0, 150}, std::pair{-0.05, 150}}) {
    action.servo[models::index(models::Servo::left_wheel)] = {.feedforward_torque = torque,
                                                              .kd_scale = 0.0};
    action.servo[models::index(models::Servo::right_wheel)] = {.feedforward_torque = -torque,
                                                               .kd_scale = 0.0};
    for (int i = 0; i < steps; ++i) {
      simulator->step(action);
      leaned += simulator->control_period() * (simulator->observation().pitch - upright);
    }
  }
  const double turned = pendulum.inertia * simulator->observation().pitch_rate;
  const double pushed = pendulum.coupling / pendulum.wheel_radius * rolled();
  const double pulled = pendulum.gravity * leaned;
  EXPECT_GT(std::abs(turned), 0.05);
  EXPECT_LT(pushed * turned, 0.0) << "the wheels move in the opposite direction";
  EXPECT_NEAR(turned + pushed, pulled, 0.05 * std::abs(turned));
}

/// Four times Upkie's mass, legs twice as long, and stronger motors.
class LargeRobot : public InEveryEngine {
 protected:
  LargeRobot() {
    std::string mjcf = read_file(TOUCHDOWN_SOURCE_DIR "/models/upkie.xml");
    for (const auto& [weak, strong] :
         {std::pair{"\"-16 16\"", "\"-64 64\""}, std::pair{"\"-1.7 1.7\"", "\"-6.8 6.8\""}}) {
      mjcf = std::regex_replace(mjcf, std::regex(weak), strong);
    }
    write_atomically(folder_ / "strong.xml", mjcf);
    write_atomically(folder_ / "large.yaml", "mjcf: strong.xml\nmass: 4\nlegs: {length: 2}\n");
  }

  logs::Outcome standing_with(const std::string& gains) const {
    const std::string text = "name: large\nrobot: " + (folder_ / "large.yaml").string() +
                             "\nend: {duration: 4}\nbalancer: {gains: " + gains + "}\n";
    return *play(complete_scenario(YamlDocument::parse(text, "large")), GetParam()).info.outcome;
  }

  ScratchFolder folder_;
};

TEST_P(LargeRobot, StandsWithItsOwnGainsAndFallsWithUpkies) {
  EXPECT_EQ(standing_with("lqr"), logs::Outcome::finished);
  EXPECT_EQ(standing_with("touchdown"), logs::Outcome::fell);
}

INSTANTIATE_TEST_SUITE_P(Engine, LargeRobot, ::testing::ValuesIn(simulators::simulator_names()),
                         engine_name);

std::string name_of(const ::testing::TestParamInfo<RobotAndEngine>& info) {
  const std::filesystem::path file = std::get<0>(info.param);
  return file.stem().string() + "_" + std::get<1>(info.param);
}

INSTANTIATE_TEST_SUITE_P(All, Robot,
                         ::testing::Combine(::testing::ValuesIn(robots()),
                                            ::testing::ValuesIn(simulators::simulator_names())),
                         name_of);

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
  const logs::Recording recording = play(stair, engine);
  EXPECT_EQ(recording.info.outcome, logs::Outcome::finished);
  Drop drop{.flights = flights(recording, 0.05)};
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
  for (std::size_t i = 0; i < bullet.flights.size(); ++i) {
    EXPECT_NEAR(mujoco.flights[i], bullet.flights[i], 0.01) << i;
  }
  EXPECT_NEAR(mujoco.peak, bullet.peak, 0.05 * bullet.peak);
  EXPECT_GT(drop_of("upkie.xml", "bullet").peak, 1.2 * drop_of("upkie.xml", "mujoco").peak)
      << "the engines' own contacts differ more";
}

class HeldJoints : public InEveryEngine {
 protected:
  /// A file of Upkie with hip rolls that are held.
  std::string robot(const std::string& mjcf, const std::string& keys = "") const {
    folder_.write("rolling.xml", mjcf);
    return folder_
        .write("rolling.yaml",
               "# Upkie with hip rolls.\nmjcf: rolling.xml\n"
               "held: [left_roll, right_roll]\n" +
                   keys)
        .string();
  }

  /// Lets the robot stand. `push`: a force to the left after 0.1 s (N).
  static logs::Recording stand(const std::string& robot, double seconds, double push = 0.0) {
    Scenario scenario = standing(seconds);
    if (push > 0.0) {
      scenario.forces = {{.time = 0.1, .duration = 0.3, .force = Eigen::Vector3d(0.0, push, 0.0)}};
    }
    scenario.robot = robot;
    return play(scenario, GetParam());
  }

  ScratchFolder folder_;
};

TEST_P(HeldJoints, FollowTheLawOfTheirServos) {
  for (const auto& [joint, keys, reference, kp, kd, effort] :
       std::vector<std::tuple<std::string, std::string, double, double, double, double>>{
           {"", "held_servo: {kp: 150, kd: 3}\n", 0.0, 150.0, 3.0, 40.0},
           {"", "held_servo: {kp: 30, kd: 1}\n", 0.0, 30.0, 1.0, 40.0},
           {"", "held_servo: {kp: 150, kd: 0}\n", 0.0, 150.0, 0.0, 40.0},
           {"ref=\"0.2\"", "held_servo: {kp: 150, kd: 3}\n", 0.2, 150.0, 3.0, 40.0},
           {"ref=\"-3\" range=\"-3.5 -2.5\"", "held_servo: {kp: 150, kd: 3}\n", -3.0, 150.0, 3.0,
            40.0},
           {"", "held_servo: {kp: 150, kd: 3, maximum_torque: 0.5}\n", 0.0, 150.0, 3.0, 0.5}}) {
    const logs::Recording run = stand(robot(rolling_upkie(joint), keys), 0.5, 12.0);
    ASSERT_GT(run.steps(), 100U);
    double moved = 0.0;
    for (std::size_t k = 1; k < run.steps(); ++k) {
      for (std::size_t i = 0; i < 2; ++i) {
        ASSERT_THAT(run.truth[k].held, SizeIs(2));
        const models::ServoReading& before = run.truth[k - 1].held[i];
        const double torque =
            std::clamp(kp * (reference - before.position) - kd * before.velocity, -effort, effort);
        ASSERT_NEAR(run.truth[k].held[i].torque, torque, 1e-6) << keys << k;
        moved = std::max(moved, std::abs(before.position - reference));
      }
    }
    EXPECT_GT(moved, 1e-3) << "a servo needs an error to give a torque";
  }
}

TEST_P(HeldJoints, AreLikeRigidLegsIfTheirServosAreStiff) {
  const std::string stiff = "held_servo: {kp: 20000, kd: 200, maximum_torque: 10000}\n";
  const logs::Recording held = stand(robot(rolling_upkie(), stiff), 2.0);
  const std::string rigid = std::regex_replace(
      rolling_upkie("", ""), std::regex("<joint name=\"(left|right)_roll\"[^>]*>"), "");
  const logs::Recording fixed = stand(folder_.write("rigid.xml", rigid).string(), 2.0);
  ASSERT_EQ(held.steps(), fixed.steps());
  for (std::size_t k = 0; k < held.steps(); ++k) {
    ASSERT_LT((held.truth[k].base_position - fixed.truth[k].base_position).norm(), 2e-3) << k;
  }
  EXPECT_TRUE(fixed.truth.back().held.empty());
}

TEST_P(HeldJoints, AreTheSameAfterEveryResetAndInTheRecording) {
  Scenario scenario = standing(0.2);
  scenario.robot = robot(rolling_upkie("frictionloss=\"0.1\" damping=\"0.1\" armature=\"0.002\""));
  const auto simulator = make_simulator(scenario, GetParam());
  const logs::Recording first = play(scenario, *simulator, 0, 0);
  const logs::Recording second = play(scenario, *simulator, 0, 0);
  ASSERT_EQ(first.steps(), second.steps());
  EXPECT_EQ(first.truth.back().held[0].position, second.truth.back().held[0].position);
  EXPECT_EQ(first.truth.back().base_position, second.truth.back().base_position);
  logs::write_recording(first, folder_ / "run.mpack");
  const logs::Recording read = logs::read_recording(folder_ / "run.mpack");
  EXPECT_EQ(read.truth.back().held[1].position, first.truth.back().held[1].position);
  EXPECT_EQ(read.truth.back().held[1].torque, first.truth.back().held[1].torque);
}

INSTANTIATE_TEST_SUITE_P(Engine, HeldJoints, ::testing::ValuesIn(simulators::simulator_names()),
                         engine_name);

TEST(ARobotCheckOfHeldJoints, ReportsWhatHoldsThem) {
  const ScratchFolder folder;
  folder.write("rolling.xml", rolling_upkie());
  const auto check = [&](const std::string& keys) {
    return check_robot(folder.write("rolling.yaml",
                                    "# Upkie.\nmjcf: rolling.xml\n"
                                    "held: [left_roll, right_roll]\n" +
                                        keys));
  };
  const RobotCheck usual = check("");
  EXPECT_THAT(usual.complaints, IsEmpty());
  ASSERT_THAT(usual.held, SizeIs(2));
  EXPECT_EQ(usual.held[0].name, "left_roll");
  EXPECT_EQ(usual.held[0].kp, 150.0);
  EXPECT_EQ(usual.held[0].kp_source, "the file's position servo");
  EXPECT_EQ(usual.held[0].effort, 40.0);
  for (const CheckedStand& stand : usual.stands) EXPECT_LT(stand.given_way, 0.05) << stand.engine;
  EXPECT_EQ(check("held_servo: {kp: 99}\n").held[1].kp_source, "held_servo");
  // Without a torque the legs splay.
  EXPECT_THAT(check("held_servo: {maximum_torque: 0}\n").complaints, Each(HasSubstr("standing")));
}

}  // namespace
}  // namespace touchdown::scenarios
