#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "noise/sensors/draws.hpp"
#include "noise/sensors/profile.hpp"

namespace touchdown::noise {

/// Sine and cosine of a wheel's angle times an order, multiplied by the wheel's speed, per step.
struct WheelTurns {
  std::vector<double> sine;
  std::vector<double> cosine;
};

WheelTurns wheel_turns(std::span<const double> position, std::span<const double> velocity,
                       double order);

/// The turns of both wheels at the order of a channel's vibration: left, right.
using TurnsOfBoth = std::array<WheelTurns, 2>;

/// State of a channel within a run.
struct ChannelState {
  std::size_t step = 0;   ///< number of the next step
  double walked = 0.0;    ///< random walk of the bias
  double process = 0.0;   ///< coloured noise
  double filtered = 0.0;  ///< last output of the low-pass
};

/// The channel's constant bias in this run.
double bias_of(const SensorChannel& channel, const ChannelDraws& draws);

/// Applies the value errors of a channel to the next steps in place: scale, bias and its random
/// walk, vibration, coloured noise, low-pass, white noise, range, resolution. `turns` belong to the
/// same steps; null without vibration.
void disturb_values(std::span<double> values, const SensorChannel& channel, double period,
                    ChannelDraws& draws, ChannelState& state, const TurnsOfBoth* turns = nullptr);

}  // namespace touchdown::noise
