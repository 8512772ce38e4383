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

}  // namespace touchdown::noise
