#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "estimator/torque_channel.hpp"

namespace touchdown::experiments {

/// Standard deviations of the sensor noise that one lane of a sweep adds to a clean recording.
struct BatchNoise {
  double knee_torque = 0.0;   ///< N·m
  double wheel_torque = 0.0;  ///< N·m
  double acceleration = 0.0;  ///< m/s²

  bool operator==(const BatchNoise&) const = default;
};

/// Throws InputError for no levels, and for one that is negative or not finite.
void check_levels(std::span<const BatchNoise> levels);

/// What all lanes of one level have in common is done once: the levels that differ, and which of
/// them each lane uses.
template <typename Level>
struct BatchByLevel {
  std::vector<Level> level;
  std::vector<std::uint32_t> level_index;

  /// `part` tells which part of a lane's noise counts. Throws InputError as `check_levels`.
  template <typename Part>
  BatchByLevel(std::span<const BatchNoise> lanes, const Part& part) {
    check_levels(lanes);
    for (const BatchNoise& lane : lanes) {
      const Level wanted = std::invoke(part, lane);
      const auto same = std::find(level.begin(), level.end(), wanted);
      level_index.push_back(static_cast<std::uint32_t>(same - level.begin()));
      if (same == level.end()) level.push_back(wanted);
    }
  }
};

/// The part of a lane's noise that torques have.
inline BatchNoise torque_part(const BatchNoise& lane) {
  return {lane.knee_torque, lane.wheel_torque, 0.0};
}

/// One step's standard normal draws, shared by all lanes: a lane's sensor reads
/// clean + standard deviation × draw, with torques in the joints' own signs.
struct NoiseStep {
  std::array<TorqueSample, 2> torque;
  double acceleration = 0.0;                    ///< along the world's vertical
  std::array<double, 3> linear_acceleration{};  ///< in the IMU frame
};

}  // namespace touchdown::experiments
