#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "noise/sensors/draws.hpp"
#include "noise/sensors/profile.hpp"

namespace touchdown::noise {

/// Steps from `begin` to `end` that a sensor drops.
struct Drop {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The drops of a run, the first step never among them. How long a sensor reports, and how long it
/// does not, are geometric.
std::vector<Drop> drops_of(const Dropout& dropout, double period, std::size_t steps,
                           const ChannelDraws& draws);

/// A new value every so many steps, held in between. A sample that falls between two steps is
/// heard, and taken, at the later one.
template <typename T>
void hold(std::span<T> values, double samples_per_step) {
  constexpr double rounding = 1e-9;
  double sample = 0.0;
  for (std::size_t k = 1; k < values.size(); ++k) {
    const double now = std::floor(static_cast<double>(k) * samples_per_step + rounding);
    if (now == sample) values[k] = values[k - 1];
    sample = now;
  }
}

/// The value of so many steps before; the first one until then.
template <typename T>
void delay(std::span<T> values, std::size_t steps) {
  if (values.empty()) return;
  const auto late = static_cast<std::ptrdiff_t>(std::min(steps, values.size() - 1));
  std::copy_backward(values.begin(), values.end() - late, values.end());
  std::fill_n(values.begin(), late, values.front());
}

/// What a sensor's clock makes of its values: held samples, delay, dropout. `nothing` is not a
/// number. Steps whose record is missing are marked, and their values left as they are.
template <typename T>
void disturb_clock(std::span<T> values, const SensorChannel& channel, double period,
                   const ChannelDraws& draws, const T& nothing,
                   std::vector<std::uint8_t>& missing) {
  if (channel.rate > 0.0) hold(values, channel.rate * period);
  if (channel.delay > 0.0) {
    delay(values, static_cast<std::size_t>(std::llround(channel.delay / period)));
  }
  if (channel.dropout.rate == 0.0) return;
  for (const Drop& drop : drops_of(channel.dropout, period, values.size(), draws)) {
    const std::span<T> dropped = values.subspan(drop.begin, drop.end - drop.begin);
    switch (channel.dropout.kind) {
      case DropKind::missing:
        missing.resize(values.size());
        std::fill_n(missing.begin() + static_cast<std::ptrdiff_t>(drop.begin), dropped.size(), 1);
        break;
      case DropKind::frozen:
        std::fill(dropped.begin(), dropped.end(), T(values[drop.begin - 1]));
        break;
      case DropKind::nan:
        std::fill(dropped.begin(), dropped.end(), nothing);
        break;
    }
  }
}

}  // namespace touchdown::noise
