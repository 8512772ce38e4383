#pragma once

#include <cmath>

#include "estimator/contact_estimator.hpp"

namespace touchdown {

/// When signals are not to be believed, and how fast a belief fades without them.
struct SignalGuardConfig {
  /// A step longer than this (s), or back in time, is a gap. A step of zero is not.
  double maximum_gap = 0.02;
  /// The accelerometer is frozen once it has repeated itself to the bit for this long (s); 0 =
  /// never. Real sensors do not repeat themselves; a noiseless simulated robot at rest may.
  double frozen_after = 0.5;
  /// An acceleration beyond this (m/s²) is invalid like NaN: one such sample would leave rounding
  /// errors larger than the signal in the sliding spectrum.
  double largest_acceleration = 1e4;
  /// A torque beyond this (N·m) is invalid like NaN: no servo of a robot that jumps has it.
  double largest_torque = 1e4;
  /// Time constant (s) with which the belief relaxes to the prior while there is nothing to update
  /// it with.
  double relaxation = 0.1;

  bool operator==(const SignalGuardConfig&) const = default;
};

/// Whether a servo can have measured this (N·m).
[[nodiscard]] inline bool is_torque(double torque, const SignalGuardConfig& config = {}) noexcept {
  return std::abs(torque) <= config.largest_torque;  // written so that NaN fails
}

/// Whether the knee's and the wheel's torques can be used.
[[nodiscard]] inline bool has_torques(const LegSignals& leg,
                                      const SignalGuardConfig& config = {}) noexcept {
  return is_torque(leg.knee.torque, config) && is_torque(leg.wheel.torque, config);
}

/// Watches the clock and the accelerometer for what no filter should swallow.
class SignalGuard {
 public:
  /// What became of one step.
  struct Verdict {
    SignalStatus status = SignalStatus::good;
    /// Since the previous step (s); infinite when time went backwards.
    double elapsed = 0.0;
    /// What was remembered from earlier samples no longer precedes this one.
    bool restart = false;
    /// The acceleration can be used.
    bool acceleration_good = true;
  };

  /// Throws InputError for a rate, a relaxation, a largest acceleration or a largest torque that is
  /// not positive, and for negative times.
  SignalGuard(const SignalGuardConfig& config, double sample_rate);

  void reset() noexcept;

  Verdict check(double time, double vertical_acceleration) noexcept;

  /// The belief after `elapsed` seconds without a measurement: Eq. (2a) with the same switch
  /// probability both ways, which tends to the flat prior P(C) = 0.5.
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
