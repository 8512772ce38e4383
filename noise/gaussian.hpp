#pragma once

#include <cstdint>
#include <span>

#include "models/robot.hpp"

namespace touchdown::noise {

/// Identifies the experiment (seed) and the run that the noise belongs to.
struct NoiseKey {
  std::uint64_t seed = 0;
  std::uint64_t run = 0;
};

/// The sensors that noise can be added to. The numbers are part of every draw: never change one;
/// only add new ones.
enum class NoiseChannel : std::uint16_t {
  left_knee_torque = 0,
  left_wheel_torque = 1,
  right_knee_torque = 2,
  right_wheel_torque = 3,
  accelerometer_x = 4,
  accelerometer_y = 5,
  accelerometer_z = 6,
  left_hip_torque = 7,
  right_hip_torque = 8,
  gyroscope_x = 9,
  gyroscope_y = 10,
  gyroscope_z = 11,
  orientation_x = 12,
  orientation_y = 13,
  orientation_z = 14,
  left_hip_position = 16,
  left_knee_position = 17,
  left_wheel_position = 18,
  right_hip_position = 19,
  right_knee_position = 20,
  right_wheel_position = 21,
  left_hip_velocity = 32,
  left_knee_velocity = 33,
  left_wheel_velocity = 34,
  right_hip_velocity = 35,
  right_knee_velocity = 36,
  right_wheel_velocity = 37,
};

constexpr NoiseChannel position_channel(models::Servo servo) {
  return static_cast<NoiseChannel>(16 + static_cast<int>(servo));
}

constexpr NoiseChannel velocity_channel(models::Servo servo) {
  return static_cast<NoiseChannel>(32 + static_cast<int>(servo));
}

/// A draw from the standard normal distribution. It is a pure function of its arguments: the order
/// of calls, threads, other channels and the machine do not change its bits. Philox4x32-10, with
/// the seed as key and (run, channel, step) as counter, gives 128 bits for two steps. The
/// Box-Muller transform turns these into two draws. Steps go up to 2^48.
double standard_normal(const NoiseKey& key, NoiseChannel channel, std::uint64_t step);

/// The same draws for consecutive steps from `first_step` on, several times faster.
void fill_standard_normal(const NoiseKey& key, NoiseChannel channel, std::uint64_t first_step,
                          std::span<double> draws);

}  // namespace touchdown::noise
