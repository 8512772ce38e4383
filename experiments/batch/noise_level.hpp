#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
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

/// The distinct values of a list, and the index of each item's value. Work that depends on the
/// value alone is done once per distinct value.
template <typename Value>
struct Distinct {
  std::vector<Value> value;
  std::vector<std::size_t> index;

  void add(const Value& item) {
    const auto same = std::find(value.begin(), value.end(), item);
    index.push_back(static_cast<std::size_t>(same - value.begin()));
    if (same == value.end()) value.push_back(item);
  }
};

/// The levels of accelerometer noise, and those of torque noise. Throw InputError as
/// `check_levels`.
Distinct<double> acceleration_levels(std::span<const BatchNoise> batch);
Distinct<BatchNoise> torque_levels(std::span<const BatchNoise> batch);
/// The standard deviations of torque noise at knees or wheels: element i has that of 2i at its
/// knees and that of 2i + 1 at its wheels. Whatever depends on one joint alone is computed once per
/// standard deviation, for a robot with that at all joints. Throws InputError as `check_levels`.
Distinct<double> torque_sigmas(std::span<const BatchNoise> batch);

/// Standard normal draws of one step, shared by all elements of a batch. The sensors of an element
/// report clean + standard deviation × draw, with torques in the joints' own signs.
struct NoiseStep {
  std::array<TorqueSample, 2> torque;
  double acceleration = 0.0;                    ///< along the world's vertical
  std::array<double, 3> linear_acceleration{};  ///< in the IMU frame
};

/// What the knee's and the wheel's sensors report if both have this noise.
inline TorqueSample noisy_torque(const LegSignals& clean, const TorqueSample& draw,
                                 double sigma) noexcept {
  return {clean.knee.torque + sigma * draw.knee, clean.wheel.torque + sigma * draw.wheel};
}

}  // namespace touchdown::experiments
