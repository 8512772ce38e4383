#include "estimator/odometry/filter.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/odometry/lie.hpp"
#include "tests/odometry/rolling_robot.hpp"

namespace touchdown::odometry {
namespace {

using Eigen::Vector3d;
using Vector15 = Eigen::Matrix<double, 15, 1>;
using test::adjoint;
using test::inverse;
using test::log_se23;
using test::log_so3;
using test::RollingRobot;

OdometryState at(const ExtendedPose& pose) {
  OdometryState start;
  start.pose = pose;
  start.covariance.diagonal().setConstant(1e-8);
  return start;
}

/// estimate · truth⁻¹ in the algebra, and the biases' errors.
Vector15 error_of(const OdometryState& state, const ExtendedPose& truth,
                  const Vector3d& gyroscope = Vector3d::Zero(),
                  const Vector3d& accelerometer = Vector3d::Zero()) {
  Vector15 error;
  error.head<9>() = log_se23(state.pose * inverse(truth));
  for (int i = 0; i < 3; ++i) {
    error[9 + i] = state.gyroscope_bias[i] - gyroscope[i];
    error[12 + i] = state.accelerometer_bias[i] - accelerometer[i];
  }
  return error;
}

TEST(ContactOdometry, FollowsIdealSensors) {
  const RollingRobot robot;
  ContactOdometry odometry;
  odometry.reset(at(robot.pose(0.0)));
  for (int k = 0; k <= 20'000; ++k) odometry.update(robot.sample(k));
  const ExtendedPose truth = robot.pose(20.0);
  EXPECT_GT(truth.position.head<2>().norm(), 3.0);
  EXPECT_LT((odometry.state().pose.position - truth.position).norm(), 2e-3);
  EXPECT_LT((odometry.state().pose.velocity - truth.velocity).norm(), 1e-3);
  EXPECT_LT(log_so3(odometry.state().pose.rotation * truth.rotation.transpose()).norm(), 1e-4);
}

TEST(ContactOdometry, TakesOffAndLandsByTheImuAlone) {
  // Stopped wheels in the air must not brake the estimate if P(contact) is 0.
  const RollingRobot robot;
  ContactOdometry always_contact, true_contact;
  for (ContactOdometry* odometry : {&always_contact, &true_contact})
    odometry->reset(at(robot.pose(0.0)));
  for (int k = 0; k <= 5000; ++k) {
    OdometrySample sample = robot.sample(k);
    if (k % 1000 > 700) {
      for (LegJoints& leg : sample.leg) leg.velocity[2] = 0.0;
    }
    always_contact.update(sample);
    if (k % 1000 > 700) sample.p_contact = {0.0, 0.0};
    true_contact.update(sample);
  }
  const ExtendedPose truth = robot.pose(5.0);
  EXPECT_LT((true_contact.state().pose.position - truth.position).norm(), 2e-3);
  EXPECT_GT((always_contact.state().pose.position - truth.position).norm(), 5e-2);
}

TEST(ContactOdometry, WeighsAWheelByItsProbability) {
  // Both wheels report standstill. The lower P(contact), the less this slows the estimate down.
  const RollingRobot robot;
  double last = -1.0;
  for (const double p : {1.0, 0.99, 0.9, 0.5, 0.1, 0.01, 0.0}) {
    ContactOdometry odometry;
    odometry.reset(at(robot.pose(0.0)));
    for (int k = 0; k <= 300; ++k) {
      OdometrySample sample = robot.sample(k);
      for (LegJoints& leg : sample.leg) leg.velocity[2] = 0.0;
      sample.p_contact = {p, p};
      odometry.update(sample);
    }
    const double speed = odometry.state().pose.velocity.norm();
    EXPECT_GT(speed, last) << p;
    last = speed;
  }
}

TEST(ContactOdometry, LinearisesTheMeasurementAsFiniteDifferencesDo) {
  // One update after a small error in one direction only. Heading is left out, as it is not
  // observable. With prior variance in this direction only and a tight measurement, the error must
  // vanish if H is right.
  const RollingRobot robot;
  OdometryConfig config;
  config.slope = 0.0;
  config.doubt = 0.0;
  for (const int direction : {0, 1, 3, 4, 5, 9, 10, 11}) {
    OdometryState start = at(robot.pose(1.0));
    start.covariance.setZero();
    start.covariance(direction, direction) = 1.0;
    constexpr double small = 1e-5;
    Vector15 error = Vector15::Zero();
    error[direction] = small;
    start.pose = exp_se23(error.head<9>()) * start.pose;
    start.gyroscope_bias += error.segment<3>(9);
    config.contact_noise = 1e-6;
    ContactOdometry odometry(config);
    odometry.reset(start);
    odometry.update(robot.sample(1000));  // begins
    odometry.update(robot.sample(1001));
    const Vector15 left = error_of(odometry.state(), robot.pose(1.001));
    EXPECT_LT(std::abs(left[direction]), 0.02 * small) << direction;
  }
}

TEST(ContactOdometry, HasErrorsThatMatchItsCovariance) {
  // Normalised estimation error squared over many draws of noise, biases and initial states. The
  // wheels of this robot have no sideways and vertical errors, so that the mean is somewhat lower.
  OdometryConfig config;
  config.gyroscope_noise = 5e-4;
  config.accelerometer_noise = 1e-2;
  config.accelerometer_share = 0.0;
  config.gyroscope_walk = config.accelerometer_walk = 0.0;
  config.contact_noise = 5e-3;
  config.slope = 0.0;
  const RollingRobot robot;
  constexpr int runs = 40;
  constexpr int steps = 3000;
  std::vector<OdometrySample> clean;
  for (int k = 0; k <= steps; ++k) clean.push_back(robot.sample(k));
  double total = 0.0;
  double horizontal = 0.0;
  for (std::uint32_t run = 0; run < runs; ++run) {
    touchdown::test::Normal normal(run + 1);
    const auto draw = [&](double deviation) -> Vector3d {
      const double x = normal(), y = normal(), z = normal();
      return deviation * Vector3d(x, y, z);
    };
    const Vector3d gyroscope = draw(3e-3);
    const Vector3d accelerometer = draw(0.1);
    OdometryState start;
    start.covariance.diagonal() << Vector3d::Constant(4e-4), Vector3d::Constant(1e-2),
        Vector3d::Constant(1e-4), Vector3d::Constant(9e-6), Vector3d::Constant(1e-2);
    Vector9 wrong;
    for (int i = 0; i < 9; ++i) wrong[i] = (i < 3 ? 0.02 : i < 6 ? 0.1 : 0.01) * normal();
    start.pose = exp_se23(wrong) * robot.pose(0.0);
    ContactOdometry odometry(config);
    odometry.reset(start);
    const double root = 1.0 / std::sqrt(RollingRobot::step);
    for (OdometrySample sample : clean) {
      const Eigen::Matrix3d to_imu = robot.robot.imu_in_base.transpose();
      sample.angular_velocity += to_imu * (gyroscope + draw(root * config.gyroscope_noise));
      sample.specific_force += to_imu * (accelerometer + draw(root * config.accelerometer_noise));
      for (LegJoints& leg : sample.leg) {
        leg.velocity[2] += root * config.contact_noise / robot.robot.wheel_radius * normal();
      }
      odometry.update(sample);
    }
    const Vector15 error = error_of(odometry.state(), robot.pose(steps * RollingRobot::step),
                                    gyroscope, accelerometer);
    total += error.dot(Eigen::MatrixXd(odometry.state().covariance).llt().solve(error)) / runs;
    const Eigen::Matrix2d speeds = odometry.state().covariance.block<2, 2>(3, 3);
    horizontal += error.segment<2>(3).dot(speeds.inverse() * error.segment<2>(3)) / runs;
  }
  // Of 15 degrees of freedom and 40 runs: 15 ± 2.6 (three standard errors).
  EXPECT_LT(total, 15.0 + 2.6);
  EXPECT_GT(total, 9.0);
  EXPECT_LT(horizontal, 2.0 + 0.95);
  EXPECT_GT(horizontal, 0.8);
}

TEST(ContactOdometry, CannotObservePositionAndHeading) {
  // The same measurements from another start give the same path, moved and rotated.
  const RollingRobot robot;
  ExtendedPose moved;
  moved.rotation = Eigen::AngleAxisd(2.1, Vector3d::UnitZ()).toRotationMatrix();
  moved.position = Vector3d(3.0, -2.0, 1.0);
  OdometryState start = at(robot.pose(0.0));
  start.covariance.diagonal().head<3>().setConstant(1e-3);
  OdometryState elsewhere = start;
  elsewhere.pose = moved * start.pose;
  // Errors are in the world frame, so their covariance rotates, too.
  Eigen::Matrix<double, 15, 15> turn = Eigen::Matrix<double, 15, 15>::Identity();
  turn.topLeftCorner<9, 9>() = adjoint(moved);
  elsewhere.covariance = turn * start.covariance * turn.transpose();
  ContactOdometry here, there;
  here.reset(start);
  there.reset(elsewhere);
  const double heading = here.state().covariance(2, 2);
  for (int k = 0; k <= 3000; ++k) {
    OdometrySample sample = robot.sample(k);
    sample.leg[0].velocity[2] += 0.5 * std::sin(0.01 * k);  // something to correct
    here.update(sample);
    there.update(sample);
    // Heading (e_z, 0, 0) and position (0, 0, e_i): no measurement reduces their variance.
    ASSERT_GE(here.state().covariance(2, 2), heading);
    ASSERT_GE(here.state().covariance(6, 6), 1e-8);
  }
  EXPECT_LT((log_se23(there.state().pose * inverse(moved * here.state().pose))).norm(), 1e-6);
}

TEST(ContactOdometry, FindsItsTiltAndItsBiases) {
  const RollingRobot robot;
  OdometryState start = at(robot.pose(0.0));
  start.covariance.diagonal() << 1e-2, 1e-2, 1e-8, 1e-2, 1e-2, 1e-2, 1e-8, 1e-8, 1e-8,
      Vector3d::Constant(1e-4), Vector3d::Constant(1e-4);
  start.pose.rotation = exp_so3(Vector3d(0.05, -0.05, 0.0)) * start.pose.rotation;
  start.gyroscope_bias = Vector3d(0.01, -0.01, 0.0);
  ContactOdometry odometry;
  odometry.reset(start);
  for (int k = 0; k <= 10'000; ++k) odometry.update(robot.sample(k));
  const Vector15 error = error_of(odometry.state(), robot.pose(10.0));
  EXPECT_LT(error.head<2>().norm(), 2e-3);
  EXPECT_LT(error.segment<2>(9).norm(), 1e-3);
}

TEST(ContactOdometry, StartsWithTheTiltOfItsAccelerometer) {
  OdometrySample sample;
  const Eigen::Matrix3d tilt =
      (Eigen::AngleAxisd(0.2, Vector3d::UnitY()) * Eigen::AngleAxisd(-0.1, Vector3d::UnitX()))
          .toRotationMatrix();
  sample.specific_force = upkie().imu_in_base.transpose() * tilt.transpose() * Vector3d(0, 0, 9.81);
  ContactOdometry odometry;
  odometry.update(sample);
  EXPECT_LT((odometry.state().pose.rotation - tilt).norm(), 1e-9);
  EXPECT_NEAR(odometry.state().planar().heading, 0.0, 1e-12);
}

TEST(ContactOdometry, IgnoresValuesThatAreNotFinite) {
  const RollingRobot robot;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ContactOdometry odometry;
  odometry.reset(at(robot.pose(0.0)));
  for (int k = 0; k <= 2000; ++k) {
    OdometrySample sample = robot.sample(k);
    if (k % 50 == 10) sample.angular_velocity.x() = nan;
    if (k % 50 == 20) sample.specific_force.setConstant(nan);
    if (k % 50 == 30) sample.leg[0].velocity[2] = std::numeric_limits<double>::infinity();
    if (k % 50 == 40) sample.p_contact[1] = nan;
    if (k % 50 == 5) sample.time = nan;  // the record is missing
    odometry.update(sample);
    ASSERT_TRUE(odometry.state().pose.position.allFinite()) << k;
    ASSERT_TRUE(odometry.state().covariance.allFinite()) << k;
  }
  EXPECT_LT((odometry.state().pose.position - robot.pose(2.0).position).norm(), 5e-3);
}

TEST(ContactOdometry, StaysPositiveDefiniteAndARotation) {
  const RollingRobot robot;
  ContactOdometry odometry;
  for (int k = 0; k <= 60'000; ++k) odometry.update(robot.sample(k));
  const Eigen::Matrix3d rotation = odometry.state().pose.rotation;
  EXPECT_LT((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  const auto& covariance = odometry.state().covariance;
  EXPECT_LT((covariance - covariance.transpose()).norm(), 1e-12 * covariance.norm());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(covariance).eigenvalues().minCoeff(),
            -1e-15);
}

TEST(ContactOdometry, RepeatsItselfToTheBit) {
  const RollingRobot robot;
  ContactOdometry once, again;
  for (int k = 0; k <= 500; ++k) once.update(robot.sample(k));
  for (int round = 0; round < 2; ++round) {
    again.reset();
    for (int k = 0; k <= 500; ++k) again.update(robot.sample(k));
    EXPECT_EQ(once.state().pose.position, again.state().pose.position);
    EXPECT_EQ(once.state().covariance, again.state().covariance);
  }
}

TEST(ContactOdometry, RefusesWhatMakesNoSense) {
  OdometryConfig config;
  config.contact_noise = 0.0;
  EXPECT_THROW(ContactOdometry{config}, InputError);
  config = {};
  config.robot.wheel_radius = -0.05;
  EXPECT_THROW(ContactOdometry{config}, InputError);
  config = {};
  config.doubt = std::nan("");
  EXPECT_THROW(ContactOdometry{config}, InputError);
}

}  // namespace
}  // namespace touchdown::odometry
