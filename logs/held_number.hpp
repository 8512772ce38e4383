#pragma once

#include <limits>
#include <optional>

#include "estimator/signal_guard.hpp"

namespace touchdown::logs {

/// How long a missing number is held from an earlier record (s): as long as estimators bridge a
/// gap, and a rounding error of the clock.
inline constexpr double longest_hold = SignalGuardConfig{}.maximum_gap + 1e-6;

/// The last value of a number, which stands for it in records that lack it: servos that did not
/// report, empty cells of a table that joins several rates, joints of another message.
struct HeldNumber {
  double value = 0.0;
  double time = -std::numeric_limits<double>::infinity();  ///< of the value (s)

  /// How old the value is (s); nothing if it is older than `longest`, or of a later time.
  std::optional<double> age(double now, double longest = longest_hold) const {
    const double since = now - time;
    return since >= 0.0 && since <= longest ? std::optional(since) : std::nullopt;
  }
};

}  // namespace touchdown::logs
