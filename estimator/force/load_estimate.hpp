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
  void reset() noexcept { sums_ = {}; }

  /// The loads of a step. NaN for a leg without usable signals, which starts anew, and beyond the
  /// limit.
  std::array<WheelLoad, 2> update(const std::array<FootJacobian, 2>& foot,
                                  const std::array<LegLoad, 2>& leg,
                                  const LoadNoise& noise) noexcept {
    const double of_torques = 1.0 / (white_ * square(noise.torque) + torque_variance_);
    const double common = white_ * square(leg_mass_ * noise.acceleration) + model_variance_;
    std::array<WheelLoad, 2> loads;
    for (std::size_t i = 0; i < 2; ++i) {
      Sums& sums = sums_[i];
      if (!leg[i].is_usable) {
        sums = {};
        continue;
      }
      const ServoLoad& servos = leg[i].by_servos;
      double weights = of_torques;
      double weighted = of_torques * leg[i].by_torques;
      if (std::isfinite(servos.force_times_determinant)) {
        if (servos.torque_noise != sums.servo_noise) {  // gains change rarely
          sums.servo_noise = servos.torque_noise;
          sums.of_servos = 1.0 / (square(servos.torque_noise) + servo_variance_);
        }
        weights += sums.of_servos;
        weighted += sums.of_servos * servos.force_times_determinant;
      }
      const double scale = arms_ * foot[i].determinant();
      sums.weight += scale * foot[i].determinant() * weights - gain_ * sums.weight;
      sums.weighted += scale * weighted - gain_ * sums.weighted;
      const double mean = 1.0 / sums.weight;
      const double variance = mean + common;
      if (variance <= largest_variance_) loads[i] = {sums.weighted * mean, std::sqrt(variance)};
    }
    return loads;
  }

 private:
  struct Sums {
    double weighted = 0.0;      ///< Σ w f
    double weight = 0.0;        ///< Σ w
    double servo_noise = -1.0;  ///< for which `of_servos` is 1/σ_τ² (1/(N²·m²))
    double of_servos = 0.0;
  };

  static double square(double x) noexcept { return x * x; }

  double gain_;
  double white_;            ///< the share of a white variance that the low-pass leaves
  double arms_;             ///< gain / a² (1/m²)
  double leg_mass_;         ///< that the torso's acceleration moves (kg)
  double torque_variance_;  ///< of errors that do not average out (N²·m²)
  double servo_variance_;   ///< likewise
  double model_variance_;   ///< N²
  double largest_variance_;
  std::array<Sums, 2> sums_;
};

}  // namespace touchdown
