#include "experiments/signals/run_signals.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "logs/signals_from.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/generation/generate.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {
namespace {

/// A run with tilting attitude and changing torques, in contact except for steps 40 to 79.
logs::Recording wobbling_run() {
  logs::Recording recording;
  for (int k = 0; k < 100; ++k) {
    models::Observation observation;
    observation.time = 1e-3 * k;
    observation.imu.orientation =
        Eigen::AngleAxisd(0.02 * k, Eigen::Vector3d(1, 2, 3).normalized());
    observation.imu.linear_acceleration = {0.1 * k, -0.2 * k, 3.0};
    for (models::ServoReading& servo : observation.servo) servo.torque = 0.01 * k;
    recording.observation.push_back(observation);
    models::Action action;
    action.servo[index(models::Servo::left_wheel)].velocity = k;
    action.servo[index(models::Servo::right_wheel)].velocity = -k;
    recording.action.push_back(action);
    models::GroundTruth truth;
    truth.wheel_normal_force.fill(k < 40 || k >= 80 ? 25.0 : 0.0);
    recording.truth.push_back(truth);
  }
  return recording;
}

TEST(RunSignals, HaveTheCommandOfThePreviousStep) {
  const RunSignals run = signals_of(wobbling_run(), {}, {}, scoring::SampleUnit::run);
  EXPECT_EQ(run.signals[0].ground_velocity_command, 0.0);
  EXPECT_NEAR(run.signals[61].ground_velocity_command, 60 * logs::upkie_wheel_radius, 1e-12);
  EXPECT_EQ(scoring::flights(run.contact[0]),
            (std::vector<scoring::Flight>{{.takeoff = 40, .landing = 80}}));
}

/// Whether labels of a wheel are what docs/reference/metrics.md defines, step by step.
void expect_defined(const scoring::ContactSequence& contact, const std::vector<double>& force,
                    double threshold) {
  constexpr std::ptrdiff_t half = 5;  // steps of 1 ms
  const auto n = static_cast<std::ptrdiff_t>(force.size());
  const auto is_light_on_average = [&](std::ptrdiff_t k) {
    const auto begin = force.begin() + std::max(k - half, std::ptrdiff_t{0});
    const auto end = force.begin() + std::min(k + half + 1, n);
    return std::accumulate(begin, end, 0.0) / static_cast<double>(end - begin) <= threshold;
  };
  const auto air = [&](std::ptrdiff_t k) {
    return k >= 0 && k < n && contact[static_cast<std::size_t>(k)] == 0;
  };
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const bool has_force = force[static_cast<std::size_t>(k)] > threshold;
    if (air(k)) {
      ASSERT_TRUE(!has_force || is_light_on_average(k)) << k;
    } else {
      ASSERT_FALSE(is_light_on_average(k)) << k;
      ASSERT_TRUE(has_force || (!air(k - 1) && !air(k + 1))) << k;
    }
  }
  for (const scoring::Flight& flight : scoring::flights(contact)) {
    bool has_light = false;
    for (std::size_t k = flight.takeoff; k < flight.landing; ++k) {
      has_light = has_light || is_light_on_average(static_cast<std::ptrdiff_t>(k));
    }
    ASSERT_TRUE(has_light) << flight.takeoff;
  }
}

TEST(RunSignals, HaveTheLabelsOfTheRobotsWeightInBothEngines) {
  for (const std::string& engine : simulators::simulator_names()) {
    for (const double heavier : {1.0, 2.0}) {
      scenarios::Scenario scenario = scenarios::find_scenario("scenarios/stairs.yaml");
      scenario.end.duration = 4.0;
      scenario.mass_scale = heavier;
      const RunSignals run =
          signals_of(scenarios::play(scenario, engine), {}, {}, scoring::SampleUnit::run);
      EXPECT_NEAR(run.info.robot_mass, heavier * 5.33922, 1e-5);
      for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
        EXPECT_FALSE(scoring::flights(run.contact[wheel]).empty());
        expect_defined(run.contact[wheel], run.normal_force[wheel],
                       heavier * 0.019 * 5.33922 * 9.81);
      }
    }
  }
}

TEST(RunSignals, WithScaledUnitNoiseEqualNoisySensors) {
  const logs::Recording recording = wobbling_run();
  const RunSignals run = signals_of(recording, {}, {}, scoring::SampleUnit::run);
  const noise::NoiseKey key{.seed = 5, .run = 2};
  const noise::SensorNoise levels{.knee_torque = 0.5,
                                  .wheel_torque = 0.25,
                                  .acceleration = 3.0,
                                  .joint_position = 0.01,
                                  .joint_velocity = 0.4,
                                  .hip_torque = 0.7};
  const NoiseRun noise = noise_run(run, key);
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const Signals scaled = noisy(run, noise, levels, k);
    const Signals reported =
        logs::signals_from(noise::with_noise(recording.observation[k], key, k, levels),
                           run.signals[k].ground_velocity_command);
    for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
      EXPECT_NEAR(scaled.leg[leg].knee.torque, reported.leg[leg].knee.torque, 1e-12);
      EXPECT_NEAR(scaled.leg[leg].wheel.torque, reported.leg[leg].wheel.torque, 1e-12);
      EXPECT_NEAR(scaled.leg[leg].hip.torque, reported.leg[leg].hip.torque, 1e-12);
      EXPECT_NE(scaled.leg[leg].hip.torque, run.signals[k].leg[leg].hip.torque);
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

TEST(RunSignals, WithoutNoiseAreTheCleanOnes) {
  const RunSignals run = signals_of(wobbling_run(), {}, {}, scoring::SampleUnit::run);
  const Signals signals = noisy(run, noise_run(run, {}), {}, 50);
  EXPECT_EQ(signals.vertical_acceleration, run.signals[50].vertical_acceleration);
  EXPECT_EQ(signals.leg[1].wheel.torque, run.signals[50].leg[1].wheel.torque);
}

/// A run in which the IMU takes every attitude.
RunSignals tumbling_run(std::size_t steps) {
  logs::Recording recording;
  for (std::size_t i = 0; i < steps; ++i) {
    const auto t = static_cast<double>(i);
    models::Observation o;
    for (std::size_t j = 0; j < models::servo_count; ++j) {
      o.servo[j] = {std::sin(t + static_cast<double>(j)), std::cos(t),
                    0.1 * static_cast<double>(j)};
    }
    o.imu.orientation = Eigen::AngleAxisd(0.37 * t, Eigen::Vector3d(1.0, 2.0, -0.5).normalized());
    o.imu.linear_acceleration = {std::sin(t), 2.0, std::cos(3.0 * t)};
    recording.observation.push_back(o);
    recording.action.emplace_back();
    recording.truth.emplace_back();
  }
  return signals_of(recording, {}, {}, scoring::SampleUnit::run);
}

constexpr noise::NoiseKey key{42, 3};

TEST(NoiseRun, ScaledByTheLevelEqualsNoisySensorsExactly) {
  const RunSignals run = tumbling_run(501);
  const NoiseRun noise = noise_run(run, key);
  for (std::size_t step = 0; step < run.steps(); ++step) {
    models::Observation clean;
    for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
      const std::size_t knee =
          index(leg == 0 ? models::Servo::left_knee : models::Servo::right_knee);
      clean.servo[knee].torque = run.signals[step].leg[leg].knee.torque;
      clean.servo[index(models::wheel_servos[leg])].torque =
          run.signals[step].leg[leg].wheel.torque;
    }
    const models::Observation reported =
        noise::with_noise(clean, key, step, {.knee_torque = 2.5, .wheel_torque = 0.7});
    for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
      const std::size_t knee =
          index(leg == 0 ? models::Servo::left_knee : models::Servo::right_knee);
      const std::size_t wheel = index(models::wheel_servos[leg]);
      ASSERT_EQ(clean.servo[knee].torque + 2.5 * noise.joint[leg].torque[1][step],
                reported.servo[knee].torque);
      ASSERT_EQ(clean.servo[wheel].torque + 0.7 * noise.joint[leg].torque[2][step],
                reported.servo[wheel].torque);
    }
  }
}

TEST(NoiseRun, HasTheSameVerticalVarianceForAllAttitudes) {
  const NoiseRun noise = noise_run(tumbling_run(100'000), key);
  double sum = 0.0;
  for (const double value : noise.vertical_acceleration) sum += value * value;
  EXPECT_NEAR(sum / 1e5, 1.0, 5.0 * std::sqrt(2.0 / 1e5));
}

TEST(NoiseRun, OfAnEmptyRunIsEmpty) {
  EXPECT_TRUE(noise_run({}, key).vertical_acceleration.empty());
}

TEST(RunSignals, HaveTheTargetsOfThePreviousStep) {
  logs::Recording recording = wobbling_run();
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    const auto time = static_cast<double>(k);
    recording.action[k].servo[4] = {0.1, time, 0.2, 2.0, 3.0, 16.0};
  }
  const RunSignals run = signals_of(recording, {}, {}, scoring::SampleUnit::run);
  EXPECT_TRUE(std::isnan(run.signals[0].target[1].knee.kp));
  const JointTarget& knee = run.signals[61].target[1].knee;
  EXPECT_EQ(knee.position, 60.0);
  EXPECT_EQ(knee.velocity, 0.2);
  EXPECT_EQ(knee.feedforward_torque, 0.1);
  EXPECT_EQ(knee.kp, 40.0);
  EXPECT_EQ(knee.kd, 3.0);
  EXPECT_TRUE(std::isnan(run.signals[61].target[0].knee.position));
}

}  // namespace
}  // namespace touchdown::experiments
