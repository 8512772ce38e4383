#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "estimator/torque_channel.hpp"

namespace touchdown::experiments {

/// Standard deviations of the sensor noise that one element of a batch adds to a clean recording.
struct BatchNoise {
  double knee_torque = 0.0;   ///< N·m
  double wheel_torque = 0.0;  ///< N·m
  double acceleration = 0.0;  ///< m/s²

  bool operator==(const BatchNoise&) const = default;
};

/// Throws InputError for no levels, and for one that is negative or not finite.
void check_levels(std::span<const BatchNoise> levels);

/// The distinct levels of one part of the noise, and the index of each batch element's level. Work
/// that depends on this part alone is done once per distinct level.
template <typename Level>
struct BatchByLevel {
  std::vector<Level> level;
  std::vector<std::uint32_t> level_index;

  /// `part` selects the part of an element's noise. Throws InputError as `check_levels`.
  template <typename Part>
  BatchByLevel(std::span<const BatchNoise> batch, const Part& part) {
    check_levels(batch);
    for (const BatchNoise& element : batch) {
      const Level wanted = std::invoke(part, element);
      const auto same = std::find(level.begin(), level.end(), wanted);
      level_index.push_back(static_cast<std::uint32_t>(same - level.begin()));
      if (same == level.end()) level.push_back(wanted);
    }
  }
};

/// The torque noise of a batch element.
inline BatchNoise torque_part(const BatchNoise& element) {
  return {element.knee_torque, element.wheel_torque, 0.0};
}

/// One signal at many noise levels: noisy[i] = clean + sigma[i] · draw.
void add_noise(double clean, double draw, std::span<const double> sigma,
               std::span<double> noisy) noexcept;

/// Standard normal draws of one step, shared by all elements of a batch. The sensors of an element
/// report clean + standard deviation × draw, with torques in the joints' own signs.
struct NoiseStep {
  std::array<TorqueSample, 2> torque;
  double acceleration = 0.0;                    ///< along the world's vertical
  std::array<double, 3> linear_acceleration{};  ///< in the IMU frame
};

}  // namespace touchdown::experiments
