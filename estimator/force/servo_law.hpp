#pragma once

#include <limits>

#include "estimator/signal_guard.hpp"
#include "estimator/signals.hpp"

namespace touchdown {

/// The torque that a joint's servo applies by its own law (N·m), from its tracking error:
///
///     τ* = k_p (q* − q) + k_d (q̇* − q̇) + τ_ff.
///
/// Noise of the torque sensor and the zero of the encoder do not affect it. NaN if a part of the
/// target is missing.
[[nodiscard]] inline double servo_torque(const JointSignals& joint,
                                         const JointTarget& target) noexcept {
  return target.kp * (target.position - joint.position) +
         target.kd * (target.velocity - joint.velocity) + target.feedforward_torque;
}

/// The same; also NaN if the position gain is not positive, or the torque beyond the guard's bound.
[[nodiscard]] inline double servo_torque(const JointSignals& joint, const JointTarget& target,
                                         const SignalGuardConfig& guard) noexcept {
  const double torque = servo_torque(joint, target);
  return target.kp > 0.0 && is_torque(torque, guard) ? torque
                                                     : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace touchdown
