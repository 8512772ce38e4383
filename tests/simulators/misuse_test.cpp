#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "simulators/options.hpp"
#include "tests/complaint.hpp"
#include "tests/simulators/standing.hpp"

namespace touchdown::simulators {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Misuse, AnUnknownSimulatorIsReportedWithTheKnownOnes) {
  const auto robot = upkie();
  const auto of = [&](const char* name) {
    return complaint_of([&] { (void)make_simulator(name, robot, {}); });
  };
  EXPECT_THAT(of("mujocco"), AllOf(HasSubstr("unknown simulator 'mujocco'"),
                                   HasSubstr("mujoco, bullet"), HasSubstr("mean 'mujoco'?")));
  EXPECT_THAT(of("gazebo"), AllOf(HasSubstr("gazebo"), ::testing::Not(HasSubstr("did you mean"))));
  EXPECT_THAT(of(""), HasSubstr("unknown simulator ''"));
}

TEST(Misuse, BulletRefusesShapesThatItCannotRepresent) {
  const auto make = [](auto&& change) {
    const auto robot = upkie(change);
    return complaint_of([&] { (void)make_simulator("bullet", robot, {}); });
  };
  EXPECT_THAT(
      make([&](models::RobotModel& r) { r.mj->geom_type[r.tyre_geom[0]] = mjGEOM_ELLIPSOID; }),
      AllOf(HasSubstr("'left_tire'"), HasSubstr("Bullet has no counterpart")));
}

class Robust : public EveryEngine {};

TEST_P(Robust, AResetGivesTheSameBitsAgain) {
  const auto simulator = make(upkie());
  const auto run = [&] {
    RobotState start = upright();
    start.position.z() += 0.2;
    simulator->reset(start);
    std::vector<double> trace;
    for (int i = 0; i < 400; ++i) {
      simulator->step(locked(start), guide(simulator->state()));
      const RobotState& s = simulator->state();
      trace.insert(trace.end(), s.position.begin(), s.position.end());
      trace.insert(trace.end(), s.joint_velocity.begin(), s.joint_velocity.end());
      const auto& force = simulator->ground_truth().wheel_normal_force;
      trace.insert(trace.end(), force.begin(), force.end());
    }
    return trace;
  };
  const std::vector<double> first = run();
  EXPECT_EQ(run(), first);
  EXPECT_EQ(simulator->observation().time, 0.4);
}

TEST_P(Robust, NanIsUnhealthyNotACrash) {
  for (const bool in_the_air : {true, false}) {
    const auto simulator = make(upkie());
    simulator->reset(in_the_air ? at_height(3.0) : upright());
    EXPECT_TRUE(simulator->healthy());
    models::Action action = torques();
    action.servo[0].feedforward_torque = nan;
    for (int i = 0; i < 5; ++i) simulator->step(action);
    EXPECT_FALSE(simulator->healthy());
    // Only a reset makes it healthy again.
    for (int i = 0; i < 5; ++i) simulator->step(torques());
    EXPECT_FALSE(simulator->healthy());
    simulator->reset(upright());
    simulator->step(torques());
    EXPECT_TRUE(simulator->healthy());
  }
}

TEST_P(Robust, ANanForceIsUnhealthyToo) {
  const auto simulator = make(upkie());
  simulator->reset(upright());
  for (int i = 0; i < 5; ++i) {
    simulator->step(torques(), {Eigen::Vector3d(nan, 0.0, 0.0), Eigen::Vector3d::Zero()});
  }
  EXPECT_FALSE(simulator->healthy());
}

TEST_P(Robust, AbsurdVelocitiesAreUnhealthy) {
  const auto simulator = make(upkie());
  RobotState start = at_height(3.0);
  start.linear_velocity.x() = 2e3;
  simulator->reset(start);
  EXPECT_FALSE(simulator->healthy());
  start = at_height(3.0);
  start.joint_velocity[models::index(models::Servo::left_wheel)] = 2e4;
  simulator->reset(start);
  EXPECT_FALSE(simulator->healthy());
  start = at_height(2e4);
  simulator->reset(start);
  EXPECT_FALSE(simulator->healthy());
}

TEST_P(Robust, AHugePushIsSurvivedOrReported) {
  const auto simulator = make(upkie());
  simulator->reset(upright());
  for (int i = 0; i < 20; ++i) {
    simulator->step(torques(), {Eigen::Vector3d(0.0, 0.0, -1e9), Eigen::Vector3d::Zero()});
  }
  EXPECT_FALSE(simulator->healthy());
}

INSTANTIATE_TEST_SUITE_P(Engine, Robust, ::testing::ValuesIn(simulator_names()), engine_name);

SimulatorOptions read(const std::string& text) {
  return from_yaml<SimulatorOptions>(YamlDocument::parse(text, "options.yaml"));
}

std::string complaint_about(const std::string& text) {
  return complaint_of([&] { (void)read(text); });
}

TEST(SimulatorOptions, ReadsGivenValuesAndKeepsDefaults) {
  const SimulatorOptions options =
      read("physics_step_us: 500\ncontrol_step_us: 5000\ncontact: {bullet_stiffness: 1000}\n");
  EXPECT_EQ(options.steps.physics_us, 500);
  EXPECT_EQ(options.steps.control_us, 5000);
  EXPECT_EQ(options.contact.bullet_stiffness, 1000.0);
  EXPECT_EQ(options.contact.solref_time_constant, ContactModel{}.solref_time_constant);
}

TEST(SimulatorOptions, SurvivesTheRoundTrip) {
  SimulatorOptions options;
  options.steps = {250, 2000};
  options.contact = {0.02, 0.9, 2e4, 500.0, 0.001};
  YAML::Emitter out;
  out.SetDoublePrecision(17);
  out << to_node(options);
  const SimulatorOptions again = read(out.c_str());
  EXPECT_EQ(again.steps.physics_us, 250);
  EXPECT_EQ(again.steps.control_us, 2000);
  EXPECT_EQ(again.contact.solref_time_constant, 0.02);
  EXPECT_EQ(again.contact.solref_damping_ratio, 0.9);
  EXPECT_EQ(again.contact.bullet_stiffness, 2e4);
  EXPECT_EQ(again.contact.bullet_damping, 500.0);
  EXPECT_EQ(again.contact.rolling_resistance, 0.001);
}

TEST(SimulatorOptions, ComplainsOnTheLine) {
  EXPECT_THAT(complaint_about("physics_step_us: 300\ncontrol_step_us: 1000\n"),
              HasSubstr("options.yaml:2:18: control_step_us: expected a multiple"));
  EXPECT_THAT(complaint_about("physics_step_us: 0.001\n"), HasSubstr("a whole number"));
  EXPECT_THAT(complaint_about("physics_step_us: 0\n"), HasSubstr("options.yaml:1:"));
  EXPECT_THAT(complaint_about("contact: {bullet_stifness: 1}\n"),
              HasSubstr("did you mean 'bullet_stiffness'"));
  EXPECT_THAT(complaint_about("contact: {rolling_resistance: -1}\n"),
              HasSubstr("rolling_resistance"));
  EXPECT_THAT(complaint_about("contact: {rolling_resistance: .nan}\n"),
              HasSubstr("rolling_resistance"));
}

}  // namespace
}  // namespace touchdown::simulators
