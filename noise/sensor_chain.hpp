#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "noise/gaussian.hpp"
#include "noise/sensor_profile.hpp"

namespace touchdown::noise {

/// Hips got their numbers after knees and wheels.
constexpr NoiseChannel torque_channel(models::Servo servo) {
  constexpr int numbers[models::servo_count] = {7, 0, 1, 8, 2, 3};
  return static_cast<NoiseChannel>(numbers[static_cast<int>(servo)]);
}

/// The channel of an axis (x, y, z) of a sensor, given that of its x.
constexpr NoiseChannel axis_channel(NoiseChannel x, std::size_t axis) {
  return static_cast<NoiseChannel>(static_cast<std::size_t>(x) + axis);
}

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

/// Steps from `begin` to `end` (exclusive) without new values of a sensor.
struct DropoutInterval {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Draws the dropout intervals of a run in order. The first step is never in one. The lengths of
/// the dropouts and of the time between them are geometric.
class DropoutProcess {
 public:
  DropoutProcess(const Dropout& dropout, double period, const ChannelDraws& draws);

  const DropoutInterval& current() const { return current_; }
  void advance();

 private:
  double begins_;  ///< probability that a dropout begins at a step
  double ends_;    ///< probability that a step of a dropout is the last one
  ChannelDraws draws_;
  std::uint64_t drawn_ = 0;
  DropoutInterval current_ = {1, 1};
};

/// Applies the timing errors of a sensor: held samples, delay, dropout. The result does not depend
/// on how the run is split into calls.
template <typename T>
class Clock {
 public:
  /// `nothing` is the NaN value of `T`.
  Clock(const SensorChannel& channel, double period, const ChannelDraws& draws, const T& nothing)
      : samples_per_step_(channel.rate * period),
        delay_(static_cast<std::size_t>(std::llround(channel.delay / period))),
        kind_(channel.dropout.kind),
        nothing_(nothing) {
    if (channel.dropout.rate > 0.0) dropouts_.emplace(channel.dropout, period, draws);
  }

  /// Processes the next values in place. Steps without a record are marked in `missing` and keep
  /// their values. Without such steps `missing` is left unchanged.
  void report(std::span<T> values, std::vector<std::uint8_t>& missing) {
    if (samples_per_step_ > 0.0) hold(values);
    if (delay_ > 0) delay(values);
    if (dropouts_) drop_out(values, missing);
    step_ += values.size();
  }

 private:
  /// Holds each sample until the next one. A sample between two steps is taken and reported at the
  /// later step.
  void hold(std::span<T> values) {
    constexpr double rounding = 1e-9;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double now = std::floor(static_cast<double>(step_ + k) * samples_per_step_ + rounding);
      if (step_ + k > 0 && now == sample_) {
        values[k] = held_;
      } else {
        held_ = values[k];
      }
      sample_ = now;
    }
  }

  /// Delays the values by `delay_` steps. Repeats the first value until then.
  void delay(std::span<T> values) {
    for (T& value : values) {
      if (waiting_.empty()) waiting_.assign(delay_, value);
      waiting_.push_back(value);
      value = waiting_.front();
      waiting_.pop_front();
    }
  }

  void drop_out(std::span<T> values, std::vector<std::uint8_t>& missing) {
    const std::size_t end = step_ + values.size();
    for (;; dropouts_->advance()) {
      const DropoutInterval& dropout = dropouts_->current();
      const std::size_t from = std::max(dropout.begin, step_);
      const std::size_t to = std::min(dropout.end, end);
      if (from < to) {
        if (dropout.begin > step_) before_ = values[dropout.begin - step_ - 1];
        replace_dropped(values.subspan(from - step_, to - from), from - step_, values.size(),
                        missing);
      }
      if (dropout.end > end) break;
    }
    if (!values.empty()) before_ = values.back();
  }

  void replace_dropped(std::span<T> dropped, std::size_t first, std::size_t steps,
                       std::vector<std::uint8_t>& missing) {
    switch (kind_) {
      case DropoutKind::missing:
        missing.resize(steps);
        std::fill_n(missing.begin() + static_cast<std::ptrdiff_t>(first), dropped.size(), 1);
        break;
      case DropoutKind::frozen:
        std::fill(dropped.begin(), dropped.end(), before_);
        break;
      case DropoutKind::nan:
        std::fill(dropped.begin(), dropped.end(), nothing_);
        break;
    }
  }

  double samples_per_step_;  ///< 0: a new sample at every step
  std::size_t delay_;        ///< steps
  DropoutKind kind_;
  T nothing_;
  std::optional<DropoutProcess> dropouts_;
  std::size_t step_ = 0;  ///< of the next value
  double sample_ = 0.0;   ///< number of the held sample
  T held_ = {};
  std::deque<T> waiting_;
  T before_ = {};  ///< value reported last, or before the current dropout
};

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
  std::size_t step = 0;                ///< number of the next step
  double walked = 0.0;                 ///< random walk of the bias
  double process = 0.0;                ///< coloured noise
  double filtered = 0.0;               ///< last output of the low-pass
  std::array<double, 2> ringing = {};  ///< of the mount
};

/// The channel's constant bias in this run.
double bias_of(const SensorChannel& channel, const ChannelDraws& draws);

/// Applies the value errors of a channel to the next steps in place: mount, scale, bias and its
/// random walk, vibration, coloured noise, low-pass, white noise, range, resolution. `turns` belong
/// to the same steps; null without vibration.
void disturb_values(std::span<double> values, const SensorChannel& channel, double period,
                    ChannelDraws& draws, ChannelState& state, const TurnsOfBoth* turns = nullptr);

}  // namespace touchdown::noise
