#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "estimator/force/leg_geometry.hpp"
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

/// The load of the ground by the laws of a leg's servos.
struct ServoLoad {
  /// The vertical force on the foot times the Jacobian's determinant (N·m²). NaN if the torque of
  /// the hip or the knee is unknown.
  double force_times_determinant = std::numeric_limits<double>::quiet_NaN();
  /// Standard deviation of the joints' torques by the resolution of their positions (N·m).
  double torque_noise = 0.0;
};

/// As `vertical_force_times_determinant`, with the torques of the servos' laws. The joints'
/// friction can carry a load without any tracking error, so a dead band as wide reduces the torques
/// of the ground about hip and knee. Signals must be usable.
[[nodiscard]] inline ServoLoad servo_load(const LegGeometry& geometry, const FootJacobian& foot,
                                          const LegSignals& leg, const LegTargets& target,
                                          bool mirrored, double acceleration,
                                          const SignalGuardConfig& guard) noexcept {
  const auto beyond = [](double torque, double friction) {
    return torque - std::clamp(torque, -friction, friction);
  };
  const JointLoads loads =
      joint_loads(geometry, foot, servo_torque(leg.hip, target.hip, guard),
                  servo_torque(leg.knee, target.knee, guard), mirrored, acceleration);
  const double gain = std::max(target.hip.kp, target.knee.kp);
  // Rounding errors are uniform within half a step.
  return {vertical_force_times_determinant(foot, {beyond(loads.hip, geometry.hip_friction),
                                                  beyond(loads.knee, geometry.knee_friction)}),
          gain * geometry.position_resolution / (2.0 * std::numbers::sqrt3)};
}

}  // namespace touchdown
