#pragma once

#include <cstddef>
#include <cstdint>

#include "models/robot.hpp"
#include "noise/gaussian.hpp"

namespace touchdown::noise {

/// Standard deviations of the sensors' white Gaussian noise. Zero means no noise.
struct SensorNoise {
  double knee_torque = 0.0;     ///< N·m, each knee
  double wheel_torque = 0.0;    ///< N·m, each wheel
  double acceleration = 0.0;    ///< m/s², each axis of the accelerometer
  double joint_position = 0.0;  ///< rad, each servo's encoder
  double joint_velocity = 0.0;  ///< rad/s, each servo's encoder
  double hip_torque = 0.0;      ///< N·m, each hip

  bool operator==(const SensorNoise&) const = default;
};

/// Adds noise to the observation at `step` of a run. The accelerometer's noise is in the IMU frame
/// and the same with and without gravity. Attitude and gyroscope stay exact.
models::Observation with_noise(const models::Observation& observation, const NoiseKey& key,
                               std::uint64_t step, const SensorNoise& levels);

}  // namespace touchdown::noise
