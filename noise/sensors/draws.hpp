#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "noise/gaussian.hpp"

namespace touchdown::noise {

/// What a channel's draws are for. The numbers are part of every draw: never change one, only add
/// more. None is 0, so that the white noise of `with_noise` shares no draw with any.
enum class DrawnFor : std::uint16_t {
  misalignment = 1,
  scale = 2,
  bias = 3,
  walk = 4,
  vibration = 5,
  coloured = 6,
  white = 7,
  dropout = 8,
};

/// The randomness of one channel of one run: functions of (seed, run, channel, disturbance, step),
/// whatever else is drawn.
class ChannelDraws {
 public:
  ChannelDraws(const NoiseKey& key, NoiseChannel channel) : key_(key), channel_(channel) {}

  /// Of N(0, 1), one for the run.
  double constant(DrawnFor what) const;
  /// Of N(0, 1), one for every step from `first` on; valid until the next call.
  std::span<const double> series(DrawnFor what, std::size_t first, std::size_t steps);
  /// Uniform in (0, 1), the n-th of the run.
  double uniform(DrawnFor what, std::uint64_t n) const;

 private:
  NoiseChannel stream(DrawnFor what) const;

  NoiseKey key_;
  NoiseChannel channel_;
  std::vector<double> series_;
};

}  // namespace touchdown::noise
