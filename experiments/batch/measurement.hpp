#pragma once

#include <array>
#include <span>
#include <vector>

#include "estimator/bayes/filter.hpp"
#include "experiments/batch/noise_estimates.hpp"
#include "experiments/batch/noise_level.hpp"

namespace touchdown::experiments {

/// The measurement model, Eq. (4) to (6) and (14), for a batch of torque noise levels: one clean
/// recording, one noise realisation, one element per level. It alone serves sweeps of the
/// measurement-only ablation. `update` neither allocates nor throws.
class BatchedMeasurement {
 public:
  /// Throws InputError for no levels, a level that is negative or not finite, a bad configuration.
  BatchedMeasurement(MeasurementModel model, const BayesFilterConfig& config,
                     std::span<const BatchNoise> levels);

  /// Processes one step, Eq. (4) to (6) and (14). All inputs must be finite.
  void update(const Signals& clean, const NoiseStep& draws) noexcept;

  /// The same without Eq. (14), for a filter that needs only the likelihoods.
  void observe(const Signals& clean, const NoiseStep& draws) noexcept;

  /// P(m_t | S_t = C), floor included, per level.
  [[nodiscard]] std::span<const double> contact(Side side) const noexcept {
    return leg_[static_cast<std::size_t>(side)].contact;
  }
  /// P(m_t | S_t = ¬C), floor included, per level.
  [[nodiscard]] std::span<const double> no_contact(Side side) const noexcept {
    return leg_[static_cast<std::size_t>(side)].no_contact;
  }
  /// P_τ(S_t = C | m_t), Eq. (14), per level, of the last `update`.
  [[nodiscard]] std::span<const double> p_measurement(Side side) const noexcept {
    return leg_[static_cast<std::size_t>(side)].p_measurement;
  }

 private:
  struct Leg {
    std::vector<double> knee;
    std::vector<double> wheel;
    std::vector<int> cell;
    std::vector<double> knee_weight;
    std::vector<double> wheel_weight;
    std::vector<double> contact;
    std::vector<double> no_contact;
    std::vector<double> p_measurement;
  };
  void estimate_noise(const Signals& clean, const NoiseStep& draws) noexcept;
  void filter_torques(Leg& leg, const LegSignals& clean, const TorqueSample& draw, double mirror,
                      double gain) const noexcept;
  void look_up(Leg& leg) const noexcept;

  NoisyMeasurement model_;
  MeasurementConfig config_;
  /// The noise that each element estimates, and its torques before the low-pass, if it is followed.
  bool follows_noise_;
  TorqueNoiseLevels noise_levels_;
  NoiseEstimates knee_noise_;
  NoiseEstimates wheel_noise_;
  std::array<std::vector<double>, 2> noisy_knee_;
  std::array<std::vector<double>, 2> noisy_wheel_;
  double gain_;
  bool started_ = false;
  std::vector<double> knee_sigma_;
  std::vector<double> wheel_sigma_;
  std::array<Leg, 2> leg_;
};

}  // namespace touchdown::experiments
