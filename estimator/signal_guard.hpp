#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "estimator/contact_estimator.hpp"
#include "estimator/members.hpp"

namespace touchdown {

/// When signals count as unusable, and how fast a belief fades without them.
struct SignalGuardConfig {
  /// A step longer than this (s), or back in time, is a gap. A step of zero is not.
  double maximum_gap = 0.02;
  /// The accelerometer is frozen after repeating itself to the bit for this long (s); 0 = never.
  /// Real sensors do not repeat themselves. A noiseless simulated robot at rest may.
  double frozen_after = 0.5;
  /// An acceleration beyond this (m/s²) is invalid, like NaN. One such sample would leave rounding
  /// errors in the sliding spectrum that exceed the signal.
  double largest_acceleration = 1e4;
  /// A torque beyond this (N·m) is invalid, like NaN: no servo of a jumping robot reaches it.
  double largest_torque = 1e4;
  /// Time constant (s) with which the belief relaxes to the prior while no signals are usable.
  double relaxation = 0.1;

  bool operator==(const SignalGuardConfig&) const = default;
};

void members(auto& visit, MembersOf<SignalGuardConfig> auto& guard) {
  visit("guard.maximum_gap", guard.maximum_gap, Range::not_negative);
  visit("guard.frozen_after", guard.frozen_after, Range::not_negative);
  visit("guard.largest_acceleration", guard.largest_acceleration, Range::positive);
  visit("guard.largest_torque", guard.largest_torque, Range::positive);
  visit("guard.relaxation", guard.relaxation, Range::positive);
}

/// Whether a servo can have measured this torque (N·m).
[[nodiscard]] inline bool is_torque(double torque, const SignalGuardConfig& config = {}) noexcept {
  return std::abs(torque) <= config.largest_torque;  // written so that NaN fails
}

/// Whether the torques of the knee and the wheel are usable.
[[nodiscard]] inline bool has_torques(const LegSignals& leg,
                                      const SignalGuardConfig& config = {}) noexcept {
  return is_torque(leg.knee.torque, config) && is_torque(leg.wheel.torque, config);
}

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
  /// repetition.
  bool update(const Values& values) noexcept {
    const bool repeated = is_started_ && values == last_;
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

/// Checks the clock and the accelerometer, so that filters skip gaps and unusable samples.
class SignalGuard {
 public:
  /// The verdict on one step.
  struct Verdict {
    SignalStatus status = SignalStatus::good;
    /// Time since the previous step (s); infinite if time went backwards.
    double elapsed = 0.0;
    /// This sample does not follow the earlier ones: filters restart their memory.
    bool restart = false;
    /// The acceleration is usable.
    bool acceleration_good = true;
  };

  /// Throws InputError for a rate, relaxation, largest acceleration or largest torque that is not
  /// positive, and for negative times.
  SignalGuard(const SignalGuardConfig& config, double sample_rate);

  void reset() noexcept;

  Verdict check(double time, double vertical_acceleration) noexcept;

  /// The belief after `elapsed` seconds without a measurement. It is Eq. (2a) with the same switch
  /// probability in both directions, and tends to the flat prior P(C) = 0.5.
  [[nodiscard]] double relaxed(double p_contact, double elapsed) const noexcept;

 private:
  SignalGuardConfig config_;
  double time_step_;
  Repetition<1> acceleration_;
  bool started_ = false;
  double time_ = 0.0;
};

}  // namespace touchdown
