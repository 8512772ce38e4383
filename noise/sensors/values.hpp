#pragma once

#include <array>
#include <span>
#include <vector>

#include "noise/sensors/draws.hpp"
#include "noise/sensors/profile.hpp"

namespace touchdown::noise {

/// The sine and the cosine of a wheel's angle times an order, times its speed, at every step.
struct WheelTurns {
  std::vector<double> sine;
  std::vector<double> cosine;
};

WheelTurns wheel_turns(std::span<const double> position, std::span<const double> velocity,
                       double order);

/// The wheels' turns at the order of a channel's vibration: left, right.
using TurnsOfBoth = std::array<WheelTurns, 2>;

/// What a channel makes of the values that it is given, step by step, up to the moment at which
/// they are sampled: scale, bias and its walk, vibration, coloured noise, low-pass, white noise,
/// range, resolution. `turns` may be null for channels that do not vibrate.
void disturb_values(std::span<double> values, const SensorChannel& channel, double period,
                    ChannelDraws& draws, const TurnsOfBoth* turns = nullptr);

}  // namespace touchdown::noise
