#pragma once

#include <array>
#include <cmath>

#include "estimator/contact_estimator.hpp"
#include "estimator/force/servo_law.hpp"

namespace touchdown {

/// Standard deviations of the white noise of the signals behind a load, from step to step.
struct LoadNoise {
  double torque = 0.0;        ///< of the hip and the knee (N·m)
  double acceleration = 0.0;  ///< vertical (m/s²)
};

/// The vertical force on a wheel times the determinant (N·m²), as its leg's signals show it.
struct LegLoad {
  double by_torques = 0.0;
  ServoLoad by_servos = {};  ///< NaN without targets
  bool is_usable = false;    ///< whether the signals are
};

/// The normal forces of the ground on both wheels, by torques and by the servo law together:
///
///     F = Σ w f / Σ w,   w = 1/σ²,   f = (force times determinant)/d,   σ = a σ_τ/|d|,
///
/// with both sums low-passed. σ_τ² is the variance that the low-pass leaves of the torques' white
/// noise, plus that of errors that do not average out; for the servo law these include the
/// positions' resolution and the joints' friction. a is the longest arm with which torques at hip
/// and knee enter d·f, that of vertical links, and d the determinant. A straight leg has d = 0 and
/// therefore the weight 0: what was known fades, until the deviation exceeds its limit.
class LoadEstimates {
 public:
  LoadEstimates(const LegGeometry& geometry, double sample_rate) noexcept;

  /// Forgets all earlier steps.
  void reset() noexcept { weighted_ = weight_ = {}; }

  /// The loads of a step. NaN for a leg without usable signals, which starts anew, and beyond the
  /// limit.
  std::array<WheelLoad, 2> update(const std::array<FootJacobian, 2>& foot,
                                  const std::array<LegLoad, 2>& leg,
                                  const LoadNoise& noise) noexcept {
    const double of_torques = 1.0 / (white_ * square(noise.torque) + torque_variance_);
    const double common = white_ * square(leg_mass_ * noise.acceleration) + model_variance_;
    std::array<double, 2> weights;
    std::array<double, 2> weighted;
    std::array<double, 2> determinant;
    for (std::size_t i = 0; i < 2; ++i) {
      if (!leg[i].is_usable) {
        weight_[i] = weighted_[i] = weights[i] = weighted[i] = determinant[i] = 0.0;
        continue;
      }
      const ServoLoad& servos = leg[i].by_servos;
      weights[i] = of_torques;
      weighted[i] = of_torques * leg[i].by_torques;
      determinant[i] = foot[i].determinant();
      if (std::isfinite(servos.force_times_determinant)) {
        if (servos.torque_noise != servo_noise_[i]) {  // gains change rarely
          servo_noise_[i] = servos.torque_noise;
          of_servos_[i] = 1.0 / (square(servos.torque_noise) + servo_variance_);
        }
        weights[i] += of_servos_[i];
        weighted[i] += of_servos_[i] * servos.force_times_determinant;
      }
    }
    // Without branches, so that a compiler divides for both wheels at once.
    std::array<double, 2> force;
    std::array<double, 2> variance;
    for (std::size_t i = 0; i < 2; ++i) {
      const double scale = arms_ * determinant[i];
      weight_[i] += scale * determinant[i] * weights[i] - gain_ * weight_[i];
      weighted_[i] += scale * weighted[i] - gain_ * weighted_[i];
      const double mean = 1.0 / weight_[i];
      force[i] = weighted_[i] * mean;
      variance[i] = mean + common;
    }
    std::array<WheelLoad, 2> loads;
    for (std::size_t i = 0; i < 2; ++i) {
      if (variance[i] <= largest_variance_) loads[i] = {force[i], std::sqrt(variance[i])};
    }
    return loads;
  }

 private:
  static double square(double x) noexcept { return x * x; }

  double gain_;
  double white_;            ///< the share of a white variance that the low-pass leaves
  double arms_;             ///< gain / a² (1/m²)
  double leg_mass_;         ///< that the torso's acceleration moves (kg)
  double torque_variance_;  ///< of errors that do not average out (N²·m²)
  double servo_variance_;   ///< likewise
  double model_variance_;   ///< N²
  double largest_variance_;
  std::array<double, 2> weighted_ = {};               ///< Σ w f
  std::array<double, 2> weight_ = {};                 ///< Σ w
  std::array<double, 2> servo_noise_ = {-1.0, -1.0};  ///< for which `of_servos_` is 1/σ_τ²
  std::array<double, 2> of_servos_ = {};              ///< 1/(N²·m²)
};

}  // namespace touchdown
