#include "experiments/heard_run.hpp"

#include <gtest/gtest.h>

#include "recordings/signals_from.hpp"

namespace touchdown {
namespace {

/// A run with tilting attitude and changing torques, in contact but for steps 40 to 79.
Recording wobbling_run() {
  Recording recording;
  for (int k = 0; k < 100; ++k) {
    Observation observation;
    observation.time = 1e-3 * k;
    observation.imu.orientation =
        Eigen::AngleAxisd(0.02 * k, Eigen::Vector3d(1, 2, 3).normalized());
    observation.imu.linear_acceleration = {0.1 * k, -0.2 * k, 3.0};
    for (ServoReading& servo : observation.servo) servo.torque = 0.01 * k;
    recording.observation.push_back(observation);
    Action action;
    action.servo[index(Servo::left_wheel)].velocity = k;
    action.servo[index(Servo::right_wheel)].velocity = -k;
    recording.action.push_back(action);
    GroundTruth truth;
    truth.wheel_normal_force.fill(k < 40 || k >= 80 ? 25.0 : 0.0);
    recording.truth.push_back(truth);
  }
  return recording;
}

TEST(HeardRun, HearsTheCommandOfTheStepBefore) {
  const HeardRun run = hear(wobbling_run(), {}, {}, SampleUnit::run);
  EXPECT_EQ(run.signals[0].ground_velocity_command, 0.0);
  EXPECT_NEAR(run.signals[61].ground_velocity_command, 60 * upkie_wheel_radius, 1e-12);
  EXPECT_EQ(flights(run.contact[0]), (std::vector<Flight>{{.takeoff = 40, .landing = 80}}));
}

TEST(HeardRun, ScaledUnitNoiseIsWhatNoisySensorsReport) {
  const Recording recording = wobbling_run();
  const HeardRun run = hear(recording, {}, {}, SampleUnit::run);
  const NoiseKey key{.seed = 5, .run = 2};
  const NoiseLevels levels{.knee_torque = 0.5,
                           .wheel_torque = 0.25,
                           .acceleration = 3.0,
                           .joint_position = 0.01,
                           .joint_velocity = 0.4};
  const UnitNoise noise = unit_noise(run, key);
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const Signals scaled = noisy(run, noise, levels, k);
    const Signals reported = signals_from(with_noise(recording.observation[k], key, k, levels),
                                          run.signals[k].ground_velocity_command);
    for (std::size_t leg = 0; leg < wheel_count; ++leg) {
      EXPECT_NEAR(scaled.leg[leg].knee.torque, reported.leg[leg].knee.torque, 1e-12);
      EXPECT_NEAR(scaled.leg[leg].wheel.torque, reported.leg[leg].wheel.torque, 1e-12);
      EXPECT_EQ(scaled.leg[leg].hip.torque, reported.leg[leg].hip.torque);
      for (const auto joint : {&LegSignals::hip, &LegSignals::knee, &LegSignals::wheel}) {
        const JointSignals& left = scaled.leg[leg].*joint;
        const JointSignals& right = reported.leg[leg].*joint;
        EXPECT_NEAR(left.position, right.position, 1e-12);
        EXPECT_NEAR(left.velocity, right.velocity, 1e-12);
        EXPECT_NE(left.position, (run.signals[k].leg[leg].*joint).position);
        EXPECT_NE(left.velocity, (run.signals[k].leg[leg].*joint).velocity);
      }
    }
    EXPECT_LT((scaled.linear_acceleration - reported.linear_acceleration).norm(), 1e-12);
    EXPECT_NEAR(scaled.vertical_acceleration, reported.vertical_acceleration, 1e-12);
  }
}

TEST(HeardRun, WithoutNoiseHearsTheCleanSignals) {
  const HeardRun run = hear(wobbling_run(), {}, {}, SampleUnit::run);
  const Signals signals = noisy(run, unit_noise(run, {}), {}, 50);
  EXPECT_EQ(signals.vertical_acceleration, run.signals[50].vertical_acceleration);
  EXPECT_EQ(signals.leg[1].wheel.torque, run.signals[50].leg[1].wheel.torque);
}

}  // namespace
}  // namespace touchdown
