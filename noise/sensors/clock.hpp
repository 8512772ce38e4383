#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
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

/// The drops of a run, one after the other, the first step never among them. How long a sensor
/// reports, and how long it does not, are geometric.
class Drops {
 public:
  Drops(const Dropout& dropout, double period, const ChannelDraws& draws);

  const Drop& current() const { return current_; }
  void advance();

 private:
  double begins_;  ///< probability of a step that a drop begins there …
  double ends_;    ///< … and of one in a drop that it is the last
  ChannelDraws draws_;
  std::uint64_t drawn_ = 0;
  Drop current_ = {1, 1};
};

/// What a sensor's clock makes of its values, given to it in as many parts as one likes: held
/// samples, delay, dropout.
template <typename T>
class Clock {
 public:
  /// `nothing` is not a number.
  Clock(const SensorChannel& channel, double period, const ChannelDraws& draws, const T& nothing)
      : samples_per_step_(channel.rate * period),
        delay_(static_cast<std::size_t>(std::llround(channel.delay / period))),
        kind_(channel.dropout.kind),
        nothing_(nothing) {
    if (channel.dropout.rate > 0.0) drops_.emplace(channel.dropout, period, draws);
  }

  /// Steps whose record is missing are marked, and their values left as they are; nothing is marked
  /// where none is.
  void report(std::span<T> values, std::vector<std::uint8_t>& missing) {
    if (samples_per_step_ > 0.0) hold(values);
    if (delay_ > 0) delay(values);
    if (drops_) drop(values, missing);
    step_ += values.size();
  }

 private:
  /// A new value every so many steps, held in between. A sample that falls between two steps is
  /// heard, and taken, at the later one.
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

  /// The value of so many steps before; the first one until then.
  void delay(std::span<T> values) {
    for (T& value : values) {
      if (waiting_.empty()) waiting_.assign(delay_, value);
      waiting_.push_back(value);
      value = waiting_.front();
      waiting_.pop_front();
    }
  }

  void drop(std::span<T> values, std::vector<std::uint8_t>& missing) {
    const std::size_t end = step_ + values.size();
    for (;; drops_->advance()) {
      const Drop& drop = drops_->current();
      const std::size_t from = std::max(drop.begin, step_);
      const std::size_t to = std::min(drop.end, end);
      if (from < to) {
        if (drop.begin > step_) before_ = values[drop.begin - step_ - 1];
        strike_out(values.subspan(from - step_, to - from), from - step_, values.size(), missing);
      }
      if (drop.end > end) break;
    }
    if (!values.empty()) before_ = values.back();
  }

  void strike_out(std::span<T> dropped, std::size_t first, std::size_t steps,
                  std::vector<std::uint8_t>& missing) {
    switch (kind_) {
      case DropKind::missing:
        missing.resize(steps);
        std::fill_n(missing.begin() + static_cast<std::ptrdiff_t>(first), dropped.size(), 1);
        break;
      case DropKind::frozen:
        std::fill(dropped.begin(), dropped.end(), before_);
        break;
      case DropKind::nan:
        std::fill(dropped.begin(), dropped.end(), nothing_);
        break;
    }
  }

  double samples_per_step_;  ///< 0: one each
  std::size_t delay_;        ///< steps
  DropKind kind_;
  T nothing_;
  std::optional<Drops> drops_;
  std::size_t step_ = 0;  ///< of the next value
  double sample_ = 0.0;   ///< number of the one that is held
  T held_ = {};
  std::deque<T> waiting_;
  T before_ = {};  ///< what was reported at the step before the next, or before its drop
};

}  // namespace touchdown::noise
