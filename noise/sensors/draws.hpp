#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "noise/gaussian.hpp"

namespace touchdown::noise {

/// The disturbance that a draw is for. The numbers are part of every draw: never change one; only
/// add new ones. 0 is not used: it belongs to the white noise of `with_noise`.
enum class DrawnFor : std::uint16_t {
  misalignment = 1,
  scale = 2,
  bias = 3,
  walk = 4,
  vibration = 5,
  coloured = 6,
  white = 7,
  dropout = 8,
  tail = 9,
};

/// The random draws of one channel of one run. Each draw is a function of (seed, run, channel,
/// disturbance, step) and independent of other draws.
class ChannelDraws {
 public:
  ChannelDraws(const NoiseKey& key, NoiseChannel channel) : key_(key), channel_(channel) {}

  /// One draw from N(0, 1) for the whole run.
  double constant(DrawnFor what) const;
  /// One draw from N(0, 1) for every step from `first` on. The span is valid until the next call.
  std::span<const double> series(DrawnFor what, std::size_t first, std::size_t steps);
  /// The n-th draw of the run from the uniform distribution on (0, 1).
  double uniform(DrawnFor what, std::uint64_t n) const;

 private:
  NoiseChannel stream(DrawnFor what) const;

  NoiseKey key_;
  NoiseChannel channel_;
  std::vector<double> series_;
};

}  // namespace touchdown::noise
