#include "experiments/studies/closed_loop/metrics.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

using ContactTrace = std::array<scoring::ContactSequence, models::wheel_count>;

/// A robot that glides level at .5 m/s with wheels that turn at `wheel_speed`, m/s along the
/// ground: 100 ms on it, 100 ms off it, 100 ms on it.
recordings::Recording gliding(double wheel_speed) {
  recordings::Recording recording;
  recording.info.outcome = recordings::Outcome::finished;
  for (int k = 0; k < 300; ++k) {
    models::Observation observation;
    observation.time = 1e-3 * k;
    observation.pitch = k == 150 ? -0.25 : 0.1;
    observation.servo[models::index(models::Servo::left_wheel)].velocity = wheel_speed / 0.05;
    observation.servo[models::index(models::Servo::right_wheel)].velocity = -wheel_speed / 0.05;
    models::GroundTruth truth;
    truth.imu_linear_velocity = {0.5, 0.0, 0.0};
    const bool in_contact = k < 100 || k >= 200;
    truth.wheel_normal_force = {in_contact ? 26.0 : 0.0, in_contact ? 30.0 : 0.0};
    recording.observation.push_back(observation);
    recording.action.emplace_back();
    recording.truth.push_back(truth);
  }
  return recording;
}

ContactTrace true_contact() {
  ContactTrace trace;
  for (scoring::ContactSequence& wheel : trace) {
    wheel.assign(300, 1);
    std::fill(wheel.begin() + 100, wheel.begin() + 200, 0);
  }
  return trace;
}

ClosedLoopMetrics metrics_of(const recordings::Recording& recording, const ContactTrace& trace) {
  return closed_loop_metrics_of(recording, trace, odometry::upkie(), {}, {.skip = 0.0});
}

TEST(TyreSpeeds, AreThoseOfTheWheelsOverTheGround) {
  const recordings::Recording run = gliding(0.8);
  for (const double speed : tyre_speeds(run.observation[0], run.truth[0], odometry::upkie())) {
    EXPECT_NEAR(speed, 0.3, 1e-12);
  }
}

TEST(TyreSpeeds, AreZeroWhereARobotPitchesAboutItsAxlesAndRolls) {
  // The robot pitches about the axle .471 m below the IMU at 2 rad/s; the axle moves at .4 m/s and
  // the wheels roll. The legs turn with the base, so the wheels' spin relative to it is 2 rad/s
  // less.
  models::Observation observation;
  const double spin = 0.4 / 0.05 - 2.0;
  observation.servo[models::index(models::Servo::left_wheel)].velocity = spin;
  observation.servo[models::index(models::Servo::right_wheel)].velocity = -spin;
  models::GroundTruth truth;
  truth.base_angular_velocity = {0.0, 2.0, 0.0};
  const double height = 0.064 + 0.168 + 0.175;
  truth.imu_linear_velocity = {0.4 + 2.0 * height, 0.0, 0.0};
  for (const double speed : tyre_speeds(observation, truth, odometry::upkie())) {
    EXPECT_NEAR(speed, 0.0, 1e-12);
  }
}

TEST(ClosedLoopMetrics, CountsLandingsByTheSpeedOfTheirTyres) {
  const ClosedLoopMetrics found = metrics_of(gliding(0.8), true_contact());
  EXPECT_EQ(found.runs, 1);
  EXPECT_EQ(found.finished, 1);
  EXPECT_EQ(found.fell, 0);
  EXPECT_EQ(found.landings, 2);  // one of each wheel
  EXPECT_NEAR(found.landing_speed_rms(), 0.3, 1e-12);
  EXPECT_EQ(found.mean_largest_pitch(), 0.25);
  EXPECT_EQ(found.mean_largest_force(), 30.0);
  EXPECT_EQ(found.contact_us, 200'000);
  EXPECT_EQ(found.false_takeoffs, 0);
}

TEST(ClosedLoopMetrics, CountsFalseTakeoffsOfTheRobot) {
  ContactTrace trace = true_contact();
  for (scoring::ContactSequence& wheel : trace) wheel[20] = 0;
  EXPECT_EQ(metrics_of(gliding(0.5), trace).false_takeoffs, 1);
  trace[1] = true_contact()[1];  // one wheel alone is no takeoff: the robot stands on the other
  EXPECT_EQ(metrics_of(gliding(0.5), trace).false_takeoffs, 0);
}

TEST(ClosedLoopMetrics, TakesNoHopForALanding) {
  recordings::Recording run = gliding(0.8);
  for (int k = 100; k < 160; ++k) {  // 40 ms are left
    run.truth[static_cast<std::size_t>(k)].wheel_normal_force = {26.0, 26.0};
  }
  const ClosedLoopMetrics found = metrics_of(run, true_contact());
  EXPECT_EQ(found.landings, 0);
  EXPECT_TRUE(std::isnan(found.landing_speed_rms()));
}

TEST(ClosedLoopMetrics, AddsUp) {
  recordings::Recording fallen = gliding(0.4);
  fallen.info.outcome = recordings::Outcome::fell;
  ClosedLoopMetrics sum = metrics_of(gliding(0.8), true_contact());
  sum += metrics_of(fallen, true_contact());
  EXPECT_EQ(sum.runs, 2);
  EXPECT_EQ(sum.finished, 1);
  EXPECT_EQ(sum.fell, 1);
  EXPECT_NEAR(sum.landing_speed_rms(), std::sqrt(0.5 * (0.3 * 0.3 + 0.1 * 0.1)), 1e-12);
  EXPECT_NEAR(sum.mean_largest_pitch(), 0.25, 1e-12);
}

}  // namespace
}  // namespace touchdown::experiments
