#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "models/robot.hpp"
#include "noise/gaussian.hpp"
#include "recordings/recording.hpp"

namespace touchdown {

/// Standard deviations of the sensors' white Gaussian noise; zero is a perfect sensor.
struct NoiseLevels {
  double knee_torque = 0.0;     ///< N·m, each knee
  double wheel_torque = 0.0;    ///< N·m, each wheel
  double acceleration = 0.0;    ///< m/s², each axis of the accelerometer
  double joint_position = 0.0;  ///< rad, each servo's encoder
  double joint_velocity = 0.0;  ///< rad/s, each servo's encoder

  bool operator==(const NoiseLevels&) const = default;
};

/// What noisy sensors report at `step` of a run. The accelerometer's noise is in its own frame and
/// the same with and without gravity. Attitude and gyroscope stay exact.
Observation with_noise(const Observation& observation, const NoiseKey& key, std::uint64_t step,
                       const NoiseLevels& levels);

/// The noise of one whole run for a standard deviation of one, so that one realisation can be
/// scaled for every level of a sweep: clean + σ·draw is what `with_noise` reports.
struct NoiseRealisation {
  std::array<std::vector<double>, wheel_count> knee_torque;   ///< per leg, per step (N·m)
  std::array<std::vector<double>, wheel_count> wheel_torque;  ///< per leg, per step (N·m)
  /// The accelerometer's noise projected on the world's upward vertical (m/s²).
  std::vector<double> vertical_acceleration;
};

/// The realisation that belongs to a recording's steps and attitudes.
NoiseRealisation draw(const Recording& recording, const NoiseKey& key);

}  // namespace touchdown
