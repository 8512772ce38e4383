#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/complaint.hpp"
#include "tests/simulators/upkie.hpp"

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

class Robust : public EveryEngine {
 protected:
  /// Upkie on the engine's own contact, and on tyres of rubber.
  static std::vector<std::shared_ptr<const models::RobotModel>> robots() {
    return {upkie(), std::make_shared<models::RobotModel>(models::compile_robot_model(
                         TOUCHDOWN_SOURCE_DIR "/models/upkie_rubber.yaml", {}))};
  }
};

TEST_P(Robust, AResetGivesTheSameBitsAgain) {
  for (const auto& robot : robots()) {
    const auto simulator = make(robot);
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
}

TEST_P(Robust, ANanTorqueMakesTheRunUnhealthyUntilItsReset) {
  for (const auto& robot : robots()) {
    for (const bool in_the_air : {true, false}) {
      const auto simulator = make(robot);
      simulator->reset(in_the_air ? at_height(3.0) : upright());
      EXPECT_TRUE(simulator->healthy());
      models::Action action = torques();
      action.servo[0].feedforward_torque = nan;
      for (int i = 0; i < 5; ++i) simulator->step(action);
      EXPECT_FALSE(simulator->healthy());
      for (int i = 0; i < 5; ++i) simulator->step(torques());
      EXPECT_FALSE(simulator->healthy());
      simulator->reset(upright());
      simulator->step(torques());
      EXPECT_TRUE(simulator->healthy());
    }
  }
}

TEST_P(Robust, AForceThatIsNanOrHugeMakesTheRunUnhealthy) {
  for (const Eigen::Vector3d& force :
       {Eigen::Vector3d(nan, 0.0, 0.0), Eigen::Vector3d(0.0, 0.0, -1e9)}) {
    const auto simulator = make(upkie());
    simulator->reset(upright());
    for (int i = 0; i < 20; ++i) simulator->step(torques(), {force, Eigen::Vector3d::Zero()});
    EXPECT_FALSE(simulator->healthy());
  }
}

TEST_P(Robust, AbsurdPositionsAndVelocitiesAreUnhealthy) {
  std::array<RobotState, 3> starts = {at_height(3.0), at_height(3.0), at_height(2e4)};
  starts[0].linear_velocity.x() = 2e3;
  starts[1].joint_velocity[models::index(models::Servo::left_wheel)] = 2e4;
  const auto simulator = make(upkie());
  for (const RobotState& start : starts) {
    simulator->reset(start);
    EXPECT_FALSE(simulator->healthy());
  }
}

INSTANTIATE_TEST_SUITE_P(Engine, Robust, ::testing::ValuesIn(simulator_names()), engine_name);

}  // namespace
}  // namespace touchdown::simulators
