#pragma once

#include <span>
#include <vector>

#include "estimator/bayes/transition_model.hpp"
#include "experiments/lanes/magnitude_spectrum.hpp"
#include "experiments/lanes/power_spectrum.hpp"

namespace touchdown::experiments {

/// The transition model, Eq. (7) to (13), under many levels of accelerometer noise side by side.
/// The sliding transform is linear, so one of the clean signal and one of the noise serve all
/// levels. `update` neither allocates nor throws.
class TransitionLanes {
 public:
  /// Sigmas in m/s². Throws InputError for a bad configuration, or a sigma that is
  /// negative or not finite.
  TransitionLanes(const TransitionConfig& config, double sample_rate,
                  std::span<const double> sigmas);

  void reset() noexcept;

  /// One step: clean vertical acceleration (m/s²) and a standard normal draw, both finite.
  void update(double vertical_acceleration, double draw) noexcept;

  /// The transition matrix, one array per element, one value per sigma.
  [[nodiscard]] std::span<const double> contact_to_contact() const noexcept { return stay_; }
  [[nodiscard]] std::span<const double> contact_to_air() const noexcept { return takeoff_; }
  [[nodiscard]] std::span<const double> air_to_contact() const noexcept { return landing_; }
  [[nodiscard]] std::span<const double> air_to_air() const noexcept { return fly_; }

 private:
  TransitionLaw law_;
  SlidingDft clean_;
  SlidingDft noise_;
  bool magnitude_;
  MixedMagnitudeSpectrum magnitudes_;
  MixedPowerSpectrum powers_;
  std::vector<double> sigmas_;
  std::vector<SpectrumValues> spectrum_;
  std::vector<double> filtered_median_;
  std::vector<double> stay_;
  std::vector<double> takeoff_;
  std::vector<double> landing_;
  std::vector<double> fly_;
};

}  // namespace touchdown::experiments
