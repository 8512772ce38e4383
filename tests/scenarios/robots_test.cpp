#include <regex>

#include "core/files.hpp"
#include "core/resources.hpp"
#include "policies/wheeled_pendulum.hpp"
#include "scenarios/compiled_scenes.hpp"
#include "scenarios/scenario_file.hpp"
#include "scenarios/start_pose.hpp"
#include "tests/scenarios/runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::scenarios {
namespace {

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

TEST_P(Robot, StandsWhereItStarted) {
  Scenario scenario = of_this_robot("one_step");
  scenario.end.duration = 2.0;
  const recordings::Recording recording = play(scenario, engine());
  EXPECT_EQ(recording.info.outcome, recordings::Outcome::timed_out);
  const double start = recording.truth.front().base_position.x();
  for (std::size_t k = 300; k < recording.steps(); ++k) {
    const models::GroundTruth& truth = recording.truth[k];
    ASSERT_TRUE(in_contact(truth, 0) && in_contact(truth, 1)) << k;
    ASSERT_NEAR(truth.base_position.x(), start, 0.4) << k;
    ASSERT_NEAR(recording.observation[k].pitch, recording.observation[0].pitch, 0.1) << k;
  }
}

TEST_P(Robot, ComesDownAStep) {
  Scenario scenario = of_this_robot("one_step");
  scenario.start.x = 2.3;
  scenario.velocity.front().time = 0.1;
  scenario.end.settle = 0.3;
  const recordings::Recording recording = play(scenario, engine());
  EXPECT_EQ(recording.info.outcome, recordings::Outcome::finished);
  EXPECT_GE(flights(recording, 0.1).size(), 1U);
}

TEST_P(Robot, IsLiftedOffTheGroundForAnyMass) {
  Scenario scenario = of_this_robot("lift_slowly");
  scenario.end.duration = 2.5;
  const recordings::Recording recording = play(perturbed(scenario, 7, 0), engine());
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
  // Stiff legs: the pendulum's do not bend. Weight and length of a leg bend it more.
  constexpr double upkie_gravity = 19.2;  // N·m per rad of lean
  const double stiffness = 20.0 * std::max(1.0, std::pow(pendulum.gravity / upkie_gravity, 2));
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

  recordings::Outcome standing_with(const std::string& gains) const {
    const std::string text = "name: large\nrobot: " + (folder_ / "large.yaml").string() +
                             "\nend: {duration: 4}\nbalancer: {gains: " + gains + "}\n";
    return *play(complete_scenario(YamlDocument::parse(text, "large")), GetParam()).info.outcome;
  }

  ScratchFolder folder_;
};

TEST_P(LargeRobot, StandsWithItsOwnGainsAndFallsWithUpkies) {
  EXPECT_EQ(standing_with("lqr"), recordings::Outcome::finished);
  EXPECT_EQ(standing_with("touchdown"), recordings::Outcome::fell);
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

}  // namespace
}  // namespace touchdown::scenarios
