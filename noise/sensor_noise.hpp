#pragma once

#include <cstdint>

#include "models/robot.hpp"
#include "noise/gaussian.hpp"

namespace touchdown::noise {

/// Standard deviations of the sensors' white Gaussian noise; zero is a perfect sensor.
struct SensorNoise {
  double knee_torque = 0.0;     ///< N·m, each knee
  double wheel_torque = 0.0;    ///< N·m, each wheel
  double acceleration = 0.0;    ///< m/s², each axis of the accelerometer
  double joint_position = 0.0;  ///< rad, each servo's encoder
  double joint_velocity = 0.0;  ///< rad/s, each servo's encoder

  bool operator==(const SensorNoise&) const = default;
};

/// What noisy sensors report at `step` of a run. The accelerometer's noise is in its own frame and
/// the same with and without gravity. Attitude and gyroscope stay exact.
models::Observation with_noise(const models::Observation& observation, const NoiseKey& key,
                               std::uint64_t step, const SensorNoise& levels);

}  // namespace touchdown::noise
