#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "estimator/decision/config.hpp"
#include "estimator/force/wheel_loads.hpp"

namespace touchdown {

/// The features of one leg, in the left leg's signs.
struct LegFeatures {
  /// The load on the wheel (N), as far as its leg's torques show it: (d² μF + ε² F₀) / (d² + ε²).
  /// F is `vertical_force`, μ is `mass_ratio`, and d = L₁ L₂ sin q₂ is the determinant of the leg's
  /// Jacobian. A bent leg gives μF (in Upkie's crouch, F₀ weighs 2 %). A straight leg carries any
  /// load without torques; it gives F₀ = 15 N, which indicates neither contact nor air.
  /// ε² = (0.003 m²)² + (0.004 m²/(N·m) σ)²: the larger the torques' noise σ, the further a leg
  /// must be bent for its torques to count.
  double load = 0.0;
  /// The torque of the ground on the wheel (N·m), times μ: the part of the servo's torque that does
  /// not accelerate the wheel.
  double reaction = 0.0;
  /// The upward velocity of the axle relative to the hip (m/s).
  double axle_velocity = 0.0;
  /// The upward acceleration of the axle (m/s²): 0 while the wheel rolls on level ground, even if
  /// the torso falls.
  double axle_acceleration = 0.0;
};

/// The load on the wheel by the servo law (N), computed as `LegFeatures::load`.
struct ServoLoadFeature {
  double load = 0.0;  ///< F₀ while muted
  /// Whether it is muted: a target is missing, or the hip or the knee has no position gain.
  bool is_muted = true;
};

/// μ = Upkie's mass / the robot's mass. Features are scaled to Upkie's mass, because all forces and
/// torques of a robot that is heavier throughout are larger in proportion.
[[nodiscard]] inline double mass_ratio(const LegGeometry& geometry) noexcept {
  return LegGeometry{}.robot_mass / geometry.robot_mass;
}

/// Computes the features of one leg from its signals.
class LegFeatureExtractor {
 public:
  LegFeatureExtractor(const DecisionConfig& config, bool mirrored);

  void reset() noexcept { count_ = 0; }
  /// Signals must be usable. `foot` is this leg's Jacobian in this pose, `torque_noise` (N·m) that
  /// of `FeatureExtractor`.
  LegFeatures update(const LegSignals& leg, const FootJacobian& foot, double vertical_acceleration,
                     double torque_noise) noexcept;

  /// Likewise, with ε² = (0.001 m²)² + (0.004 m²/(N·m) σ)²: σ is the noise of the positions'
  /// resolution.
  [[nodiscard]] ServoLoadFeature servo_load(const LegSignals& leg, const LegTargets& target,
                                            const FootJacobian& foot,
                                            double vertical_acceleration) const noexcept;

 private:
  /// The load of `LegFeatures`, from a vertical force times the determinant (N·m²).
  /// ε is `least` (m²) without noise.
  [[nodiscard]] double load_of(const FootJacobian& foot, double force_times_area, double least,
                               double torque_noise) const noexcept;

  LegGeometry geometry_;
  SignalGuardConfig guard_;
  double mass_ratio_;
  bool mirrored_;
  double rate_;
  /// The last velocities of the wheel (rad/s) and of the axle relative to the hip (m/s), as a ring.
  std::vector<std::array<double, 2>> velocities_;
  std::size_t next_ = 0;
  std::size_t count_ = 0;  ///< of velocities since the reset
};

/// Whether all signals behind a leg's features are usable.
[[nodiscard]] inline bool is_usable(const LegSignals& leg,
                                    const SignalGuardConfig& guard) noexcept {
  return has_load(leg, guard) && is_torque(leg.wheel.torque, guard) &&
         std::isfinite(leg.hip.velocity) && std::isfinite(leg.knee.velocity) &&
         std::isfinite(leg.wheel.velocity);
}

}  // namespace touchdown
