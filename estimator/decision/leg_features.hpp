#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "estimator/decision/config.hpp"
#include "estimator/force/wheel_loads.hpp"

namespace touchdown {

/// What the decision network hears of one leg, in the left leg's signs.
struct LegFeatures {
  /// What the wheel carries (N), as far as its leg tells: (d² μF + ε² F₀) / (d² + ε²), with F of
  /// `vertical_force`, μ of `mass_ratio` and the determinant of the leg's Jacobian,
  /// d = L₁ L₂ sin q₂. A bent leg tells μF (Upkie's crouch: 2 % of F₀ in it); a straight one, which
  /// carries any load without torques, tells F₀ = 15 N, which means neither contact nor air.
  /// ε² = (0.003 m²)² + (0.004 m²/(N·m) σ)²: through torques' noise σ a leg must be bent further to
  /// be heard.
  double load = 0.0;
  /// The torque of the ground on the wheel (N·m), times μ: what its servo's does not turn into its
  /// acceleration.
  double reaction = 0.0;
  /// How fast the axle moves upwards beneath the hip (m/s).
  double axle_velocity = 0.0;
  /// How fast the axle accelerates upwards (m/s²): 0 where it rolls on level ground, however the
  /// torso falls.
  double axle_acceleration = 0.0;
};

/// Robots are heard as if they had Upkie's mass, since all forces and torques of one that is
/// heavier throughout are larger in proportion: μ = Upkie's mass / the robot's.
[[nodiscard]] inline double mass_ratio(const LegGeometry& geometry) noexcept {
  return LegGeometry{}.robot_mass / geometry.robot_mass;
}

/// From signals to channels, one leg.
class LegFeatureExtractor {
 public:
  LegFeatureExtractor(const DecisionConfig& config, bool mirrored);

  void reset() noexcept { heard_ = 0; }
  /// Signals must be usable, `foot` this leg's in this pose, `torque_noise` that of
  /// `FeatureExtractor` (N·m).
  LegFeatures update(const LegSignals& leg, const FootJacobian& foot, double vertical_acceleration,
                     double torque_noise) noexcept;

 private:
  LegGeometry geometry_;
  double mass_ratio_;
  bool mirrored_;
  double rate_;
  /// Of the wheel (rad/s) and of the axle beneath the hip (m/s): the last few, in turn.
  std::vector<std::array<double, 2>> velocities_;
  std::size_t next_ = 0;
  std::size_t heard_ = 0;
};

/// Whether all that the network hears of a leg can be used.
[[nodiscard]] inline bool is_usable(const LegSignals& leg,
                                    const SignalGuardConfig& guard) noexcept {
  return has_load(leg, guard) && is_torque(leg.wheel.torque, guard) &&
         std::isfinite(leg.hip.velocity) && std::isfinite(leg.knee.velocity) &&
         std::isfinite(leg.wheel.velocity);
}

}  // namespace touchdown
