#pragma once

#include <array>

#include "estimator/torque_channel.hpp"

namespace touchdown::experiments {

/// Standard deviations of the sensor noise that one lane of a sweep adds to a clean recording.
struct LaneNoise {
  double knee_torque = 0.0;   ///< N·m
  double wheel_torque = 0.0;  ///< N·m
  double acceleration = 0.0;  ///< m/s²

  bool operator==(const LaneNoise&) const = default;
};

/// One step's standard normal draws, shared by all lanes: a lane's sensor reads
/// clean + standard deviation × draw, with torques in the joints' own signs.
struct NoiseStep {
  std::array<TorqueSample, 2> torque;
  double acceleration = 0.0;                    ///< along the world's vertical
  std::array<double, 3> linear_acceleration{};  ///< in the IMU frame
};

}  // namespace touchdown::experiments
