#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "estimator/signal_guard.hpp"

namespace touchdown {

/// Detects that all `count` signals of one source repeat themselves to the bit. Real signals do
/// not: noise moves the last digit of one or another, even at rest.
template <std::size_t count>
class Repetition {
 public:
  using Values = std::array<double, count>;

  Repetition(const SignalGuardConfig& guard, double sample_rate) noexcept {
    const double steps = std::ceil(guard.frozen_after * sample_rate);
    if (steps > 0.0 && steps < never) steps_to_frozen_ = static_cast<int>(steps);
  }

  void reset() noexcept { *this = Repetition(steps_to_frozen_); }

  /// Takes the next step's values and returns whether they are frozen. NaN does not count as a
  /// repetition. Nor does a source that reports only zeros, because it may not exist.
  bool update(const Values& values) noexcept {
    const bool repeated = is_started_ && values == last_ && values != Values{};
    steps_ = repeated ? std::min(steps_ + 1, never - 1) : 0;
    last_ = values;
    is_started_ = true;
    return steps_ >= steps_to_frozen_;
  }

 private:
  static constexpr int never = std::numeric_limits<int>::max();

  explicit Repetition(int steps_to_frozen) noexcept : steps_to_frozen_(steps_to_frozen) {}

  int steps_to_frozen_ = never;
  int steps_ = 0;
  bool is_started_ = false;
  Values last_{};
};

}  // namespace touchdown
