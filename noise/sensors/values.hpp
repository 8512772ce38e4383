#pragma once

#include <array>
#include <cstddef>
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

/// How far a channel has come in its run, and what it remembers of it.
struct ChannelState {
  std::size_t step = 0;   ///< of the next value
  double walked = 0.0;    ///< by the bias
  double process = 0.0;   ///< the coloured noise
  double filtered = 0.0;  ///< what the low-pass gave last
};

/// What a channel makes of the values that it is given next, step by step, up to the moment at
/// which they are sampled: scale, bias and its walk, vibration, coloured noise, low-pass, white
/// noise, range, resolution. `turns` are those of these steps, null for channels that do not
/// vibrate.
void disturb_values(std::span<double> values, const SensorChannel& channel, double period,
                    ChannelDraws& draws, ChannelState& state, const TurnsOfBoth* turns = nullptr);

}  // namespace touchdown::noise
