#include "noise/sensor_noise.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/noise/observations.hpp"

namespace touchdown::noise {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

models::Observation tumbling_step(std::size_t i) {
  const auto t = static_cast<double>(i);
  models::Observation o;
  for (std::size_t j = 0; j < models::servo_count; ++j) {
    o.servo[j] = {std::sin(t + static_cast<double>(j)), std::cos(t), 0.1 * static_cast<double>(j)};
  }
  o.imu.orientation = Eigen::AngleAxisd(0.37 * t, Eigen::Vector3d(1.0, 2.0, -0.5).normalized());
  o.imu.linear_acceleration = {std::sin(t), 2.0, std::cos(3.0 * t)};
  o.imu.raw_linear_acceleration = {1.0, 2.0, 3.0};
  return o;
}

constexpr NoiseKey noisy_key{42, 3};

TEST(SensorNoise, OfEveryLevelIsOnItsOwnSensorsOnly) {
  const models::Observation o = tumbling_step(0);
  const auto changed = [&](const SensorNoise& levels) {
    return different({o}, {with_noise(o, noisy_key, 0, levels)});
  };
  EXPECT_THAT(changed({}), IsEmpty());
  EXPECT_THAT(changed({.hip_torque = 1.0}), ElementsAre("left_hip torque", "right_hip torque"));
  EXPECT_THAT(changed({.knee_torque = 1.0}), ElementsAre("left_knee torque", "right_knee torque"));
  EXPECT_THAT(changed({.wheel_torque = 1.0}),
              ElementsAre("left_wheel torque", "right_wheel torque"));
  EXPECT_THAT(changed({.acceleration = 1.0}),
              ElementsAre("linear x", "linear y", "linear z", "raw x", "raw y", "raw z"));
  EXPECT_THAT(changed({.joint_position = 1.0}),
              ElementsAre("left_hip position", "left_knee position", "left_wheel position",
                          "right_hip position", "right_knee position", "right_wheel position"));
  EXPECT_THAT(changed({.joint_velocity = 1.0}), SizeIs(6));
}

TEST(SensorNoise, TheAccelerometersNoiseIsTheSameWithAndWithoutGravity) {
  const models::Observation o = tumbling_step(0);
  const models::Observation n = with_noise(o, noisy_key, 5, {.acceleration = 3.0});
  EXPECT_TRUE((n.imu.linear_acceleration - o.imu.linear_acceleration)
                  .isApprox(n.imu.raw_linear_acceleration - o.imu.raw_linear_acceleration, 1e-13));
}

TEST(SensorNoise, IsLinearInItsLevel) {
  const models::Observation o = tumbling_step(0);
  const SensorNoise one{1.0, 1.0, 1.0, 1.0, 1.0};
  const SensorNoise three{3.0, 3.0, 3.0, 3.0, 3.0};
  const models::Observation a = with_noise(o, noisy_key, 7, one);
  const models::Observation b = with_noise(o, noisy_key, 7, three);
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    EXPECT_NEAR(b.servo[i].torque - o.servo[i].torque,
                3.0 * (a.servo[i].torque - o.servo[i].torque), 1e-13);
    EXPECT_NEAR(b.servo[i].position - o.servo[i].position,
                3.0 * (a.servo[i].position - o.servo[i].position), 1e-13);
  }
  EXPECT_TRUE((b.imu.linear_acceleration - o.imu.linear_acceleration)
                  .isApprox(3.0 * (a.imu.linear_acceleration - o.imu.linear_acceleration), 1e-13));
}

TEST(SensorNoise, OneLevelDoesNotChangeTheDrawsOfAnother) {
  const models::Observation o = tumbling_step(0);
  const models::Observation alone = with_noise(o, noisy_key, 7, {.wheel_torque = 1.0});
  const models::Observation together = with_noise(o, noisy_key, 7, {2.0, 1.0, 5.0, 0.1, 0.1});
  EXPECT_EQ(alone.servo[models::index(models::Servo::left_wheel)].torque,
            together.servo[models::index(models::Servo::left_wheel)].torque);
}

}  // namespace
}  // namespace touchdown::noise
