#include "noise/sensor_noise.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace touchdown {
namespace {

Recording tumbling_run(std::size_t steps) {
  Recording recording;
  for (std::size_t i = 0; i < steps; ++i) {
    const auto t = static_cast<double>(i);
    Observation o;
    for (std::size_t j = 0; j < servo_count; ++j) {
      o.servo[j] = {std::sin(t + static_cast<double>(j)), std::cos(t),
                    0.1 * static_cast<double>(j)};
    }
    o.imu.orientation = Eigen::AngleAxisd(0.37 * t, Eigen::Vector3d(1.0, 2.0, -0.5).normalized());
    o.imu.linear_acceleration = {std::sin(t), 2.0, std::cos(3.0 * t)};
    o.imu.raw_linear_acceleration = {1.0, 2.0, 3.0};
    recording.observation.push_back(o);
    recording.action.emplace_back();
  }
  return recording;
}

constexpr NoiseKey key{42, 3};

TEST(SensorNoise, APerfectSensorReportsWhatIs) {
  const Observation o = tumbling_run(3).observation[2];
  const Observation same = with_noise(o, key, 2, {});
  for (std::size_t i = 0; i < servo_count; ++i) {
    EXPECT_EQ(same.servo[i].torque, o.servo[i].torque);
    EXPECT_EQ(same.servo[i].position, o.servo[i].position);
    EXPECT_EQ(same.servo[i].velocity, o.servo[i].velocity);
  }
  EXPECT_EQ(same.imu.linear_acceleration, o.imu.linear_acceleration);
  EXPECT_EQ(same.imu.raw_linear_acceleration, o.imu.raw_linear_acceleration);
}

TEST(SensorNoise, EveryLevelTouchesItsOwnSensorsOnly) {
  const Observation o = tumbling_run(1).observation[0];
  const auto changed = [&](const NoiseLevels& levels) {
    const Observation n = with_noise(o, key, 0, levels);
    std::string text;
    for (std::size_t i = 0; i < servo_count; ++i) {
      text += n.servo[i].torque != o.servo[i].torque ? 't' : '.';
      text += n.servo[i].position != o.servo[i].position ? 'p' : '.';
      text += n.servo[i].velocity != o.servo[i].velocity ? 'v' : '.';
    }
    return text + (n.imu.linear_acceleration != o.imu.linear_acceleration ? 'a' : '.') +
           (n.imu.raw_linear_acceleration != o.imu.raw_linear_acceleration ? 'r' : '.') +
           (n.pitch != o.pitch || n.imu.angular_velocity != o.imu.angular_velocity ? '!' : '.');
  };
  EXPECT_EQ(changed({.knee_torque = 1.0}), "...t........t........");
  EXPECT_EQ(changed({.wheel_torque = 1.0}), "......t........t.....");
  EXPECT_EQ(changed({.acceleration = 1.0}), "..................ar.");
  EXPECT_EQ(changed({.joint_position = 1.0}), ".p..p..p..p..p..p....");
  EXPECT_EQ(changed({.joint_velocity = 1.0}), "..v..v..v..v..v..v...");
}

TEST(SensorNoise, TheAccelerometersNoiseIsTheSameWithAndWithoutGravity) {
  const Observation o = tumbling_run(1).observation[0];
  const Observation n = with_noise(o, key, 5, {.acceleration = 3.0});
  EXPECT_TRUE((n.imu.linear_acceleration - o.imu.linear_acceleration)
                  .isApprox(n.imu.raw_linear_acceleration - o.imu.raw_linear_acceleration, 1e-13));
}

TEST(SensorNoise, IsLinearInItsLevel) {
  const Observation o = tumbling_run(1).observation[0];
  const NoiseLevels one{1.0, 1.0, 1.0, 1.0, 1.0};
  const NoiseLevels three{3.0, 3.0, 3.0, 3.0, 3.0};
  const Observation a = with_noise(o, key, 7, one);
  const Observation b = with_noise(o, key, 7, three);
  for (std::size_t i = 0; i < servo_count; ++i) {
    EXPECT_NEAR(b.servo[i].torque - o.servo[i].torque,
                3.0 * (a.servo[i].torque - o.servo[i].torque), 1e-13);
    EXPECT_NEAR(b.servo[i].position - o.servo[i].position,
                3.0 * (a.servo[i].position - o.servo[i].position), 1e-13);
  }
  EXPECT_TRUE((b.imu.linear_acceleration - o.imu.linear_acceleration)
                  .isApprox(3.0 * (a.imu.linear_acceleration - o.imu.linear_acceleration), 1e-13));
}

TEST(SensorNoise, OneLevelDoesNotChangeTheDrawsOfAnother) {
  const Observation o = tumbling_run(1).observation[0];
  const Observation alone = with_noise(o, key, 7, {.wheel_torque = 1.0});
  const Observation together = with_noise(o, key, 7, {2.0, 1.0, 5.0, 0.1, 0.1});
  EXPECT_EQ(alone.servo[index(Servo::left_wheel)].torque,
            together.servo[index(Servo::left_wheel)].torque);
}

TEST(SensorNoise, ARealisationScaledByTheLevelIsWhatNoisySensorsReport) {
  const Recording recording = tumbling_run(501);
  const NoiseRealisation noise = draw(recording, key);
  const NoiseLevels levels{.knee_torque = 2.5, .wheel_torque = 0.7, .acceleration = 9.0};
  for (std::size_t step = 0; step < recording.steps(); ++step) {
    const Observation& clean = recording.observation[step];
    const Observation noisy = with_noise(clean, key, step, levels);
    for (std::size_t leg = 0; leg < wheel_count; ++leg) {
      const std::size_t knee = index(leg == 0 ? Servo::left_knee : Servo::right_knee);
      const std::size_t wheel = index(wheel_servos[leg]);
      ASSERT_EQ(clean.servo[knee].torque + 2.5 * noise.knee_torque[leg][step],
                noisy.servo[knee].torque);
      ASSERT_EQ(clean.servo[wheel].torque + 0.7 * noise.wheel_torque[leg][step],
                noisy.servo[wheel].torque);
    }
    ASSERT_NEAR(vertical_acceleration(clean.imu) + 9.0 * noise.vertical_acceleration[step],
                vertical_acceleration(noisy.imu), 1e-12);
  }
}

TEST(SensorNoise, TheVerticalNoiseKeepsItsVarianceHoweverTheRobotIsTurned) {
  const NoiseRealisation noise = draw(tumbling_run(100'000), key);
  double sum = 0.0;
  for (const double value : noise.vertical_acceleration) sum += value * value;
  EXPECT_NEAR(sum / 1e5, 1.0, 5.0 * std::sqrt(2.0 / 1e5));
}

TEST(SensorNoise, AnEmptyRunHasAnEmptyRealisation) {
  EXPECT_TRUE(draw({}, key).vertical_acceleration.empty());
}

}  // namespace
}  // namespace touchdown
