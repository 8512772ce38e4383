#pragma once

#include <array>

#include "estimator/signals.hpp"

namespace touchdown {

/// As large as that of a motor without one (N·m).
inline constexpr double no_torque_limit = 1e4;

/// One leg in its plane, hip to axle: two links, with their centres of mass on the lines between
/// the joints. The values are Upkie's.
struct LegGeometry {
  double upper_length = 0.168;  ///< hip to knee (m)
  double lower_length = 0.175;  ///< knee to axle (m)
  double upper_mass = 0.69241;  ///< kg
  double lower_mass = 0.3954;   ///< kg
  double wheel_mass = 0.18455;  ///< kg, at the axle
  double upper_centre = 0.855;  ///< of mass, as a share of the length from the hip
  double lower_centre = 0.742;  ///< likewise, from the knee
  /// Of the wheel about its axle (kg·m²), including its motor's rotor at the joint: the inertia
  /// that the servo's reported torque accelerates.
  double wheel_inertia = 1.7456e-4;
  double robot_mass = 5.33922;            ///< of the whole robot (kg), which both legs carry
  double hip_friction = 0.0;              ///< Coulomb friction of the hip (N·m)
  double knee_friction = 0.0;             ///< and of the knee (N·m)
  double position_resolution = 6.283e-4;  ///< of the hip's and the knee's positions (rad)
  double upper_inertia = 2.80122e-3;      ///< about its centre of mass (kg·m²)
  double lower_inertia = 2.12266e-3;      ///< likewise
  // Inertia of the motors' rotors, as they appear at the joints (kg·m²); the wheel's is a part of
  // `wheel_inertia`.
  double hip_armature = 0.0;
  double knee_armature = 0.0;
  double wheel_armature = 0.0;
  // Viscous friction of the joints (N·m·s/rad).
  double hip_viscous = 0.0;
  double knee_viscous = 0.0;
  double wheel_viscous = 0.0;
  // The largest torques of the motors (N·m); `no_torque_limit` where they are not known.
  double hip_torque_limit = 16.0;
  double knee_torque_limit = 16.0;
  double wheel_torque_limit = 1.7;
  // The left hip from the IMU, forward and upward in the torso (m). The right one is beside it.
  double hip_forward = 0.0;
  double hip_upward = -0.064;
  /// Of each leg's centre of mass from the torso's middle plane (m).
  double leg_sideways = 0.186481;

  /// A leg without a hip is given as one with a very long upper link, whose signals do not count.
  [[nodiscard]] bool has_hip() const noexcept { return upper_length < 10.0 * lower_length; }

  bool operator==(const LegGeometry&) const = default;
};

/// The Jacobian of a leg's foot in one pose, in the left leg's signs. With the hip at q₁ and the
/// knee at q₂ from straight, forward positive,
///
///     x = L₁ sin q₁ + L₂ sin(q₁ + q₂),   z = −L₁ cos q₁ − L₂ cos(q₁ + q₂).
///
/// The members are the derivatives (m/rad) of the terms: the upper link's by q₁, the lower link's
/// by q₁ + q₂.
struct FootJacobian {
  double upper_x;
  double upper_z;
  double lower_x;
  double lower_z;

  /// det ∂(x, z)/∂(q₁, q₂) = L₁ L₂ sin q₂ (m²): 0 for a straight leg.
  [[nodiscard]] double determinant() const noexcept {
    return upper_x * lower_z - lower_x * upper_z;
  }
};

/// For the left and the right leg; the right leg's joints have mirrored signs.
[[nodiscard]] std::array<FootJacobian, 2> foot_jacobians(
    const LegGeometry& geometry, const std::array<LegSignals, 2>& legs) noexcept;
/// For one leg. `mirrored`: the joints' signs are those of the right leg.
[[nodiscard]] FootJacobian foot_jacobian(const LegGeometry& geometry, const LegSignals& leg,
                                         bool mirrored) noexcept;

/// The torques of the ground about a leg's joints, in the left leg's signs (N·m).
struct JointLoads {
  double hip;
  double knee;
};

/// What remains of these joint torques, which are in the joints' own signs, after gravity and the
/// leg's acceleration: −τ + Σ_i m_i (g + a) ∂z_i/∂q, as below.
[[nodiscard]] inline JointLoads joint_loads(const LegGeometry& geometry, const FootJacobian& foot,
                                            double hip_torque, double knee_torque, bool mirrored,
                                            double acceleration) noexcept {
  constexpr double gravity = 9.81;
  const double sign = mirrored ? -1.0 : 1.0;
  // The moment arms of the links' and the wheel's masses about each joint (kg·m).
  const double below_knee = geometry.lower_centre * geometry.lower_mass + geometry.wheel_mass;
  const double on_knee = below_knee * foot.lower_z;
  const double on_hip =
      (geometry.upper_centre * geometry.upper_mass + geometry.lower_mass + geometry.wheel_mass) *
          foot.upper_z +
      on_knee;
  return {-sign * hip_torque + on_hip * (gravity + acceleration),
          -sign * knee_torque + on_knee * (gravity + acceleration)};
}

/// The vertical force of the ground on the foot (N) with these torques about the joints, times the
/// determinant of J (N·m²).
[[nodiscard]] inline double vertical_force_times_determinant(const FootJacobian& foot,
                                                             const JointLoads& load) noexcept {
  return (foot.upper_x + foot.lower_x) * load.knee - foot.lower_x * load.hip;
}

/// The vertical force of the ground on a leg's foot (N) that explains the leg's torques, times the
/// determinant of J (N·m²). The torso is taken to be level, and the whole leg to accelerate upwards
/// with `acceleration` (m/s², without gravity):
///
///     Jᵀ F = −τ + Σ_i m_i (g + a) ∂z_i/∂q,
///
/// over the links and the wheel, solved for F = (F_x, F_z). The product is always finite, whereas a
/// straight leg carries any load without torques.
[[nodiscard]] inline double vertical_force_times_determinant(const LegGeometry& geometry,
                                                             const FootJacobian& foot,
                                                             const LegSignals& leg, bool mirrored,
                                                             double acceleration) noexcept {
  return vertical_force_times_determinant(
      foot, joint_loads(geometry, foot, leg.hip.torque, leg.knee.torque, mirrored, acceleration));
}

/// The force alone (N). Not finite if the knee is straight.
[[nodiscard]] double vertical_force(const LegGeometry& geometry, const LegSignals& leg,
                                    bool mirrored, double acceleration) noexcept;

/// The upward velocity of the axle relative to the hip (m/s), ż of the above, if the torso is level
/// and does not turn.
[[nodiscard]] inline double axle_velocity(const FootJacobian& foot, const LegSignals& leg,
                                          bool mirrored) noexcept {
  const double sign = mirrored ? -1.0 : 1.0;
  return foot.upper_z * (sign * leg.hip.velocity) +
         foot.lower_z * (sign * leg.hip.velocity + sign * leg.knee.velocity);
}

/// The same for either leg: in the mirrored one, the signs of a sine and of a velocity cancel.
[[nodiscard]] double axle_velocity(const LegGeometry& geometry, const LegSignals& leg) noexcept;

}  // namespace touchdown
