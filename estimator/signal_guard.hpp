#pragma once

#include <cmath>

#include "estimator/contact_estimator.hpp"

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

/// Whether a servo can have measured this torque (N·m).
[[nodiscard]] inline bool is_torque(double torque, const SignalGuardConfig& config = {}) noexcept {
  return std::abs(torque) <= config.largest_torque;  // written so that NaN fails
}

/// Whether the torques of the knee and the wheel are usable.
[[nodiscard]] inline bool has_torques(const LegSignals& leg,
                                      const SignalGuardConfig& config = {}) noexcept {
  return is_torque(leg.knee.torque, config) && is_torque(leg.wheel.torque, config);
}

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
  int steps_to_frozen_;
  bool started_ = false;
  double time_ = 0.0;
  double acceleration_ = 0.0;
  int repetitions_ = 0;
};

}  // namespace touchdown
