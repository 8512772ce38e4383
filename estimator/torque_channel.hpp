#pragma once

#include <algorithm>

#include "estimator/signals.hpp"

namespace touchdown {

/// m_t of Eq. (4): the knee and wheel torque of one leg, the measurement model's input (N·m).
struct TorqueSample {
  double knee = 0.0;
  double wheel = 0.0;

  bool operator==(const TorqueSample&) const = default;
};

/// How the measurement model treats a torque's sign.
enum class TorqueSign : int {
  absolute,  ///< |τ|, as in the paper
  mirrored,  ///< τ in the left leg's convention: the right leg's joints turn the other way
};

struct TorqueConfig {
  TorqueSign sign = TorqueSign::absolute;
  /// Time constant of a first-order low-pass of the signed torques (s); 0 = none.
  double low_pass = 0.0;

  bool operator==(const TorqueConfig&) const = default;
};

/// The gain of a first-order low-pass, the share of the way to its input that it covers in one
/// step: the forward difference dt/time_constant, as in Upkie's filters, limited to 1.
inline double low_pass_gain(double time_constant, double time_step) noexcept {
  return time_constant > time_step ? time_step / time_constant : 1.0;
}

/// Computes m_t from the torques that a leg's servos report. It mirrors the right leg, low-passes
/// the signed torques, then takes absolute values if configured. The low-pass comes first so that
/// zero-mean noise averages out before a sign is dropped. It starts at its first input. Fits and
/// estimators use the same channel.
class TorqueChannel {
 public:
  TorqueChannel() = default;
  TorqueChannel(const TorqueConfig& config, Side side, double sample_rate) noexcept
      : mirror_(side == Side::left ? 1.0 : -1.0),
        gain_(low_pass_gain(config.low_pass, 1.0 / sample_rate)),
        absolute_(config.sign == TorqueSign::absolute) {}

  void reset() noexcept { started_ = false; }

  /// Torques must be finite.
  TorqueSample update(const LegSignals& leg) noexcept {
    const double knee = mirror_ * leg.knee.torque;
    const double wheel = mirror_ * leg.wheel.torque;
    const double gain = started_ ? gain_ : 1.0;
    started_ = true;
    filtered_.knee += gain * (knee - filtered_.knee);
    filtered_.wheel += gain * (wheel - filtered_.wheel);
    if (!absolute_) {
      return filtered_;
    }
    return {std::max(filtered_.knee, -filtered_.knee), std::max(filtered_.wheel, -filtered_.wheel)};
  }

 private:
  TorqueSample filtered_;
  double mirror_ = 1.0;
  double gain_ = 1.0;
  bool absolute_ = true;
  bool started_ = false;
};

}  // namespace touchdown
