#include "tests/simulators/bodies.hpp"
#include "tests/simulators/upkie.hpp"

namespace touchdown::simulators {
namespace {

void expect_near(const Eigen::Vector3d& value, const Eigen::Vector3d& expected, double tolerance) {
  EXPECT_LT((value - expected).norm(), tolerance)
      << value.transpose() << " instead of " << expected.transpose();
}

class Imu : public EveryEngine {};

TEST_P(Imu, MeasuresGravityAtRest) {
  const auto simulator = make(upkie());
  simulator->reset(upright());
  stand(*simulator, 3.0);
  const models::Observation& observation = simulator->observation();
  // The IMU's z points down and its x back, so a forward pitch shows in x.
  expect_near(observation.imu.raw_linear_acceleration,
              {g * std::sin(observation.pitch), 0.0, -g * std::cos(observation.pitch)}, 1e-3);
  EXPECT_NEAR(observation.pitch, 0.0, 0.01);
  expect_near(observation.imu.linear_acceleration, Eigen::Vector3d::Zero(), 1e-3);
  expect_near(observation.imu.angular_velocity, Eigen::Vector3d::Zero(), 1e-3);
  EXPECT_NEAR(models::vertical_acceleration(observation.imu), 0.0, 1e-3);
}

TEST_P(Imu, MeasuresNoSpecificForceInFreeFall) {
  const auto simulator = make(upkie());
  RobotState start = at_height(5.0);
  start.orientation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -0.5).normalized());
  simulator->reset(start);
  for (int i = 0; i < 10; ++i) simulator->step(torques());
  const models::ImuReading& imu = simulator->observation().imu;
  expect_near(imu.raw_linear_acceleration, Eigen::Vector3d::Zero(), 1e-9);
  EXPECT_NEAR(models::vertical_acceleration(imu), -g, 1e-9);
  EXPECT_NEAR(imu.linear_acceleration.norm(), g, 1e-9);
}

/// A base so heavy that it spins about its centre of mass at constant speed.
void make_flywheel(models::RobotModel& robot) {
  without_gravity(robot);
  robot.mj->body_mass[robot.base_body] = 1e8;
  for (int i = 0; i < 3; ++i) robot.mj->body_inertia[3 * robot.base_body + i] = 1e8;
}

TEST_P(Imu, MeasuresTheCentripetalAccelerationOfItsMount) {
  const auto model = upkie(make_flywheel);
  const auto simulator = make(model, steps_of(100));
  const Eigen::Vector3d com = models::vector_at(model->mj->body_ipos, model->base_body);
  const Eigen::Vector3d omega(0.0, 3.0, 0.0);
  RobotState start = at_height(5.0);
  start.angular_velocity = omega;
  start.linear_velocity = -omega.cross(com);
  simulator->reset(start);
  for (int i = 0; i < 100; ++i) simulator->step(torques());
  const Eigen::Vector3d arm = Eigen::Vector3d(0.0, 0.0, -0.1) - com;  // in the base frame
  const Eigen::Vector3d acceleration = omega.cross(omega.cross(arm));
  const models::ImuReading& imu = simulator->observation().imu;
  // The IMU's x points back and its z down. The difference over a step lags by half of it.
  expect_near(imu.linear_acceleration, {-acceleration.x(), acceleration.y(), -acceleration.z()},
              1e-3);
  expect_near(imu.linear_acceleration, imu.raw_linear_acceleration, 1e-12);
  expect_near(imu.angular_velocity, {0.0, 3.0, 0.0}, 1e-6);
  EXPECT_NEAR(simulator->observation().pitch_rate, 3.0, 1e-6);
}

TEST_P(Imu, PitchIsPositiveForwardAndYawToTheLeft) {
  const auto simulator = make(upkie());
  RobotState start = at_height(5.0);
  start.orientation = Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY());
  start.angular_velocity = {0.0, 0.0, 0.3};
  simulator->reset(start);
  const models::Observation& observation = simulator->observation();
  EXPECT_NEAR(observation.yaw_rate, 0.3, 1e-12);
  EXPECT_NEAR(observation.pitch, 0.3, 1e-12);
  EXPECT_NEAR(observation.yaw, 0.4, 1e-12);
  // The base's x axis, the IMU's −x, points forward and a little down in the world. In the attitude
  // reference system y and z are reversed.
  const Eigen::Vector3d ahead = observation.imu.orientation * Eigen::Vector3d(-1.0, 0.0, 0.0);
  expect_near(ahead, {std::cos(0.3) * std::cos(0.4), -std::cos(0.3) * std::sin(0.4), std::sin(0.3)},
              1e-12);
  start.orientation = Eigen::Quaterniond::Identity();
  start.angular_velocity = {0.1, 0.2, 0.3};
  simulator->reset(start);
  expect_near(simulator->observation().imu.angular_velocity, {-0.1, 0.2, -0.3}, 1e-12);
}

TEST_P(Imu, TheAccelerationIsTheDifferenceOfVelocities) {
  const auto simulator = make(upkie());
  RobotState start = upright();
  start.position.z() += 0.1;
  simulator->reset(start);
  expect_near(simulator->observation().imu.linear_acceleration, Eigen::Vector3d::Zero(), 1e-12);
  double hardest = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d before = simulator->ground_truth().imu_linear_velocity;
    simulator->step(stiff_legs(start));
    const Eigen::Vector3d after = simulator->ground_truth().imu_linear_velocity;
    const double up = models::vertical_acceleration(simulator->observation().imu);
    ASSERT_NEAR(up, (after - before).z() / 1e-3, 1e-9);
    hardest = std::max(hardest, up);
  }
  EXPECT_GT(hardest, 50.0);
}

INSTANTIATE_TEST_SUITE_P(Engine, Imu, ::testing::ValuesIn(simulator_names()), engine_name);

}  // namespace
}  // namespace touchdown::simulators
