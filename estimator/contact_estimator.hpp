#pragma once

#include <array>
#include <string_view>

#include "estimator/signals.hpp"

namespace touchdown {

/// What an estimator believes about one wheel.
struct WheelBelief {
  /// P(S_t = C | m_0:t).
  double p_contact = 0.5;
  /// The estimator's own decision, from `p_contact` by its threshold (or hysteresis).
  bool contact = false;
};

/// Whether the last signals could be used as they were.
enum class SignalStatus : int {
  good,     ///< the step was used as it came
  invalid,  ///< NaN or infinite input: the belief relaxed towards the prior
  gap,      ///< time jumped: the window was restarted and the belief relaxed
  frozen,   ///< a sensor repeats itself to the bit: the belief relaxed
};

/// "good", "invalid", "gap", "frozen".
constexpr std::string_view to_text(SignalStatus status) noexcept {
  switch (status) {
    case SignalStatus::good:
      return "good";
    case SignalStatus::invalid:
      return "invalid";
    case SignalStatus::gap:
      return "gap";
    case SignalStatus::frozen:
      return "frozen";
  }
  return "";
}

/// What an estimator believes about the robot after one step.
struct Belief {
  /// Left wheel, right wheel.
  std::array<WheelBelief, 2> wheel;
  /// P(at least one wheel is in contact).
  double p_any_wheel = 0.5;
  /// P(both wheels are in contact).
  double p_both_wheels = 0.5;
  SignalStatus status = SignalStatus::good;
};

/// The seam for contact estimators. One call of `update` per time step; neither call allocates,
/// locks or throws, so that it can run in a robot's control loop.
class ContactEstimator {
 public:
  virtual ~ContactEstimator() = default;

  /// Forget everything: the belief is the flat prior, P(S_0 = C) = 0.5.
  virtual void reset() noexcept = 0;

  /// Take one step of signals and return the new belief.
  virtual const Belief& update(const Signals& signals) noexcept = 0;
};

}  // namespace touchdown
