#pragma once

#include <array>
#include <span>
#include <vector>

#include "estimator/bayes/config.hpp"
#include "estimator/bayes/noisy_measurement.hpp"
#include "estimator/bayes/transition_model.hpp"
#include "experiments/batch/noise_level.hpp"

namespace touchdown::experiments {

/// `MeasurementOnly` for a batch of noise levels, for sweeps: one clean recording, one noise
/// realisation, one element per level. The probabilities of each element equal those of a
/// `MeasurementOnly` with the input clean + sigma × draw. It has no signal guard; all inputs must
/// be finite. `update` neither allocates nor throws.
class BatchedMeasurement {
 public:
  /// Throws InputError for no levels, a level that is negative or not finite, a bad configuration.
  BatchedMeasurement(MeasurementModel model, const BayesFilterConfig& config,
                     std::span<const BatchNoise> levels);

  /// Processes one step of clean signals, Eq. (4) to (6) and (14). Each element scales the draws by
  /// its own sigmas.
  void update(const Signals& clean, const NoiseStep& draws) noexcept;

  /// Eq. (6), floors included, by element.
  [[nodiscard]] std::span<const Likelihoods> likelihoods(Side side) const noexcept {
    return likelihoods_[static_cast<std::size_t>(side)];
  }
  /// P_τ(S_t = C | m_t), Eq. (14), by element.
  [[nodiscard]] std::span<const double> p_contact(Side side) const noexcept {
    return p_contact_[static_cast<std::size_t>(side)];
  }

 private:
  NoisyMeasurement model_;
  Distinct<double> sigmas_;                          ///< standard deviations of torque noise
  std::vector<TorqueMemory> memory_;                 ///< by standard deviation
  std::vector<std::array<TorqueSample, 2>> torque_;  ///< m_t of both legs, by standard deviation
  std::array<std::vector<Likelihoods>, 2> likelihoods_;
  std::array<std::vector<double>, 2> p_contact_;
};

/// `BayesFilter` for a batch of noise levels, likewise. Elements with the same torque noise share
/// the measurement model, and elements with the same accelerometer noise the transition model. Only
/// the recursion runs per element, so that a grid of levels costs little more than that. The
/// beliefs of each element equal those of a `BayesFilter` with the input clean + sigma × draw. It
/// has no signal guard; all inputs must be finite. `update` neither allocates nor throws.
class BatchedBayesFilter {
 public:
  /// Throws InputError for no levels, a level that is negative or not finite, a bad configuration.
  BatchedBayesFilter(MeasurementModel model, const BayesFilterConfig& config,
                     std::span<const BatchNoise> levels);

  /// Processes one step of clean signals. Each element scales the draws by its own sigmas.
  void update(const Signals& clean, const NoiseStep& draws) noexcept;

  /// P(S_t = C | m_0:t) of one wheel, by element.
  [[nodiscard]] std::span<const double> p_contact(Side side) const noexcept {
    return contact_[static_cast<std::size_t>(side)];
  }

 private:
  Distinct<BatchNoise> torque_;
  Distinct<double> acceleration_;
  BatchedMeasurement measurement_;           ///< by level of torque noise
  std::vector<TransitionModel> transition_;  ///< by level of accelerometer noise
  /// bel(S_t = C) and bel(S_t = ¬C) per wheel and element.
  std::array<std::vector<double>, 2> contact_;
  std::array<std::vector<double>, 2> no_contact_;
};

}  // namespace touchdown::experiments
