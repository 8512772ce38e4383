#pragma once

#include <array>

#include "estimator/members.hpp"
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
  double robot_mass = 5.33922;        ///< of the whole robot (kg), which both legs carry
  double hip_friction = 0.0;          ///< Coulomb friction of the hip (N·m)
  double knee_friction = 0.0;         ///< and of the knee (N·m)
  double upper_inertia = 2.80122e-3;  ///< about its centre of mass (kg·m²)
  double lower_inertia = 2.12266e-3;  ///< likewise
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

void members(auto& visit, MembersOf<LegGeometry> auto& geometry) {
  visit("geometry.upper_length", geometry.upper_length, Range::positive);
  visit("geometry.lower_length", geometry.lower_length, Range::positive);
  visit("geometry.upper_mass", geometry.upper_mass, Range::any);
  visit("geometry.lower_mass", geometry.lower_mass, Range::any);
  visit("geometry.wheel_mass", geometry.wheel_mass, Range::any);
  visit("geometry.upper_centre", geometry.upper_centre, Range::any);
  visit("geometry.lower_centre", geometry.lower_centre, Range::any);
  visit("geometry.upper_inertia", geometry.upper_inertia, Range::any);
  visit("geometry.lower_inertia", geometry.lower_inertia, Range::any);
  visit("geometry.hip_armature", geometry.hip_armature, Range::any);
  visit("geometry.knee_armature", geometry.knee_armature, Range::any);
  visit("geometry.wheel_armature", geometry.wheel_armature, Range::any);
  visit("geometry.hip_viscous", geometry.hip_viscous, Range::any);
  visit("geometry.knee_viscous", geometry.knee_viscous, Range::any);
  visit("geometry.wheel_viscous", geometry.wheel_viscous, Range::any);
  visit("geometry.hip_torque_limit", geometry.hip_torque_limit, Range::any);
  visit("geometry.knee_torque_limit", geometry.knee_torque_limit, Range::any);
  visit("geometry.wheel_torque_limit", geometry.wheel_torque_limit, Range::any);
  visit("geometry.hip_forward", geometry.hip_forward, Range::any);
  visit("geometry.hip_upward", geometry.hip_upward, Range::any);
  visit("geometry.leg_sideways", geometry.leg_sideways, Range::any);
  visit("wheel_inertia", geometry.wheel_inertia, Range::any);
  visit("robot_mass", geometry.robot_mass, Range::positive);
  visit("hip_friction", geometry.hip_friction, Range::any);
  visit("knee_friction", geometry.knee_friction, Range::any);
}

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

/// `mirrored`: the joints' signs are those of the right leg.
[[nodiscard]] FootJacobian foot_jacobian(const LegGeometry& geometry, const LegSignals& leg,
                                         bool mirrored) noexcept;

}  // namespace touchdown
