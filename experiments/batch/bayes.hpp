#pragma once

#include <array>
#include <span>
#include <vector>

#include "estimator/bayes/transition_model.hpp"
#include "experiments/batch/magnitude_spectrum.hpp"
#include "experiments/batch/measurement.hpp"
#include "experiments/batch/noise_level.hpp"
#include "experiments/batch/power_spectrum.hpp"

namespace touchdown::experiments {

/// The transition model, Eq. (7) to (13), for a batch of accelerometer noise levels. The sliding
/// transform is linear, so all levels share one transform of the clean signal and one of the noise.
/// `update` neither allocates nor throws.
class BatchedTransitions {
 public:
  /// Takes sigmas in m/s², which the caller has checked. Throws InputError for a bad configuration.
  BatchedTransitions(const TransitionConfig& config, double sample_rate,
                     std::span<const double> sigmas);

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

/// `BayesFilter` for a batch of noise levels, for sweeps: one clean recording, one noise
/// realisation, and structures of arrays with one element per level. Elements with the same torque
/// noise share lookups, and elements with the same accelerometer noise share spectra. A grid of
/// levels thereby costs little more than its recursions. The beliefs of each element equal those of
/// a `BayesFilter` with the input clean + sigma × draw, to 1e-12.
///
/// It is meant for recordings: unlike `BayesFilter` it has no guard against gaps or frozen sensors.
/// It skips a step with a value that is not finite, and the beliefs stay as they were. `update`
/// neither allocates nor throws.
class BatchedBayesFilter {
 public:
  /// Throws InputError for no levels, a level that is negative or not finite, a bad configuration.
  BatchedBayesFilter(MeasurementModel model, const BayesFilterConfig& config,
                     std::span<const BatchNoise> levels);

  /// Processes one step of clean signals. Each element scales the draws by its own sigmas.
  void update(const Signals& clean, const NoiseStep& draws) noexcept;

  /// The number of noise levels.
  [[nodiscard]] std::size_t size() const noexcept { return torque_.level_index.size(); }
  /// P(S_t = C | m_0:t) of one wheel, per noise level.
  [[nodiscard]] std::span<const double> p_contact(Side side) const noexcept {
    return contact_[static_cast<std::size_t>(side)];
  }

 private:
  BatchByLevel<BatchNoise> torque_;
  BatchByLevel<double> acceleration_;
  BatchedMeasurement measurement_;
  BatchedTransitions transition_;
  /// bel(S_t = C) and bel(S_t = ¬C) per wheel and noise level.
  std::array<std::vector<double>, 2> contact_;
  std::array<std::vector<double>, 2> no_contact_;
};

}  // namespace touchdown::experiments
