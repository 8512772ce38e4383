#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "estimator/torque_channel.hpp"

/// Where a function is compiled twice, for the build's processor and for vectors of 512 bits, the
/// program picks one at run time. Both give the same bits: each operation stays the same, and no
/// sum changes its order. That needs a build with fused multiplications (x86-64-v3). Sanitizers
/// start too late for the choice.
#if defined(__GNUC__) && !defined(__clang__) && defined(__FMA__) && defined(__linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TOUCHDOWN_HAS_WIDE_VECTORS
/// Marks a function with loops that fill such vectors with elements of a batch.
#define TOUCHDOWN_WIDE_VECTORS [[gnu::target_clones("arch=x86-64-v4", "default")]]
#else
#define TOUCHDOWN_WIDE_VECTORS
#endif

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

/// Standard normal draws of one step, shared by all elements of a batch. The sensors of an element
/// report clean + standard deviation × draw, with torques in the joints' own signs.
struct NoiseStep {
  std::array<TorqueSample, 2> torque;
  double acceleration = 0.0;                    ///< along the world's vertical
  std::array<double, 3> linear_acceleration{};  ///< in the IMU frame
};

/// The standard deviations of torque noise that a batch has at knees or wheels, without repetition,
/// and for each element the index of that at its knees and at its wheels. Whatever depends on one
/// joint alone is computed once per standard deviation, for a robot with that at all joints.
struct TorqueSigmas {
  struct Element {
    std::uint32_t knee;
    std::uint32_t wheel;
  };

  /// Throws InputError as `check_levels`.
  explicit TorqueSigmas(std::span<const BatchNoise> batch);

  std::vector<double> sigma;
  std::vector<Element> element;
};

/// What the knee's and the wheel's sensors report if both have this noise.
inline TorqueSample noisy_torque(const LegSignals& clean, const TorqueSample& draw,
                                 double sigma) noexcept {
  return {clean.knee.torque + sigma * draw.knee, clean.wheel.torque + sigma * draw.wheel};
}

}  // namespace touchdown::experiments
