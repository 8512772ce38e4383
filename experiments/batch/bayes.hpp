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

/// The transition model, Eq. (7) to (13), under many levels of accelerometer noise side by side.
/// The sliding transform is linear, so one of the clean signal and one of the noise serve all
/// levels. `update` neither allocates nor throws.
class BatchedTransitions {
 public:
  /// Sigmas in m/s², checked by the caller. Throws InputError for a bad configuration.
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

/// `BayesFilter` under many noise levels side by side, for sweeps: one clean recording and one
/// noise realisation, one lane per level, structures of arrays inside. Lanes that share their
/// torque noise share lookups and lanes that share their accelerometer noise share spectra, so that
/// a grid of levels costs little more than its recursions. Each lane's beliefs equal those of a
/// `BayesFilter` that is fed clean + sigma × draw, to 1e-12.
///
/// Meant for recordings: unlike `BayesFilter` it has no guard against gaps or frozen sensors; a
/// step with a value that is not finite is skipped, which leaves the beliefs as they were. `update`
/// neither allocates nor throws.
class BatchedBayesFilter {
 public:
  /// Throws InputError for no levels, a level that is negative or not finite, a bad configuration.
  BatchedBayesFilter(MeasurementModel model, const BayesFilterConfig& config,
                   std::span<const BatchNoise> levels);

  /// One step of the clean signals, with the draws that every lane scales by its own sigmas.
  void update(const Signals& clean, const NoiseStep& draws) noexcept;

  [[nodiscard]] std::size_t lanes() const noexcept { return torque_.level_index.size(); }
  /// P(S_t = C | m_0:t) of one wheel, per lane in the order of the levels.
  [[nodiscard]] std::span<const double> p_contact(Side side) const noexcept {
    return contact_[static_cast<std::size_t>(side)];
  }

 private:
  BatchByLevel<BatchNoise> torque_;
  BatchByLevel<double> acceleration_;
  BatchedMeasurement measurement_;
  BatchedTransitions transition_;
  /// bel(S_t = C) and bel(S_t = ¬C) per wheel and lane.
  std::array<std::vector<double>, 2> contact_;
  std::array<std::vector<double>, 2> no_contact_;
};

}  // namespace touchdown::experiments
