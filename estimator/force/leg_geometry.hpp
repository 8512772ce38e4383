#pragma once

#include "estimator/signals.hpp"

namespace touchdown {

/// One leg in its plane, hip to axle: two links whose centres of mass lie on the lines between the
/// joints. The values are Upkie's.
struct LegGeometry {
  double upper_length = 0.168;  ///< hip to knee (m)
  double lower_length = 0.175;  ///< knee to axle (m)
  double upper_mass = 0.69241;  ///< kg
  double lower_mass = 0.3954;   ///< kg
  double wheel_mass = 0.18455;  ///< kg, at the axle
  double upper_centre = 0.855;  ///< of mass, as a share of the length from the hip
  double lower_centre = 0.742;  ///< likewise, from the knee
  /// Of the wheel about its axle (kg·m²), with its motor's rotor as the joint feels it: what the
  /// torque that the servo reports sets in motion.
  double wheel_inertia = 1.7456e-4;

  bool operator==(const LegGeometry&) const = default;
};

/// The vertical force of the ground on a leg's foot (N) that explains its torques, if the torso is
/// level and all of the leg accelerates upwards with `acceleration` (m/s², without gravity). With
/// the hip at q₁ and the knee at q₂ from straight, forward positive,
///
///     x = L₁ sin q₁ + L₂ sin(q₁ + q₂),   z = −L₁ cos q₁ − L₂ cos(q₁ + q₂),
///     Jᵀ F = −τ + Σ_i m_i (g + a) ∂z_i/∂q,
///
/// over the links and the wheel, solved for F = (F_x, F_z). `mirrored`: the joints' signs are those
/// of the right leg. Not finite where the knee is straight: a straight leg carries any load without
/// torques.
[[nodiscard]] double vertical_force(const LegGeometry& geometry, const LegSignals& leg,
                                    bool mirrored, double acceleration) noexcept;

/// How fast the axle moves upwards beneath the hip (m/s), ż of the above, if the torso is level and
/// does not turn. For both legs: where one is mirrored, the signs of a sine and of a velocity
/// cancel.
[[nodiscard]] double axle_velocity(const LegGeometry& geometry, const LegSignals& leg) noexcept;

}  // namespace touchdown
