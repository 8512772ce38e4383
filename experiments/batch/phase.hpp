#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "estimator/phase/prepared_model.hpp"
#include "experiments/batch/noise_estimates.hpp"
#include "experiments/batch/noise_level.hpp"
#include "experiments/batch/phase_recursion.hpp"

namespace touchdown::experiments {

/// `PhaseFilter` for a batch of noise levels, for sweeps: one clean recording, one noise
/// realisation, one element per level. Elements with the same torque noise share the lookups and
/// the noise estimate of torques, and likewise for accelerometer noise. Only the recursion runs per
/// element. The beliefs and decisions of each element equal those of a `PhaseFilter` with the input
/// clean + sigma × draw.
///
/// It is meant for recordings: it has no guard against gaps or frozen sensors, and all inputs must
/// be finite. `update` neither allocates nor throws.
class BatchedPhaseFilter {
 public:
  /// Throws InputError as `PhaseFilter`, and for no levels or bad ones.
  BatchedPhaseFilter(std::shared_ptr<const PhaseModel> model, const PhaseFilterConfig& config,
                     std::span<const BatchNoise> levels);

  /// Processes one step of clean signals. Each element scales the draws by its own sigmas.
  void update(const Signals& clean, const NoiseStep& draws) noexcept;

  /// The number of noise levels.
  [[nodiscard]] std::size_t size() const noexcept { return torque_.level_index.size(); }
  /// P(S_t = C | m_0:t) of one wheel, per noise level.
  [[nodiscard]] std::span<const double> p_contact(Side side) const noexcept {
    return std::span(p_contact_[static_cast<std::size_t>(side)]).first(size());
  }
  /// The decision about one wheel, per noise level: 1 for contact, 0 for none.
  [[nodiscard]] std::span<const double> contact(Side side) const noexcept {
    return std::span(contact_[static_cast<std::size_t>(side)]).first(size());
  }

 private:
  /// One level of accelerometer noise.
  struct AccelerationLevel {
    double sigma;
    NoiseEstimate<1> noise;
  };
  void add_torque_noise(const Signals& clean, const NoiseStep& draws) noexcept;
  void look_up_torques() noexcept;
  void look_up_accelerations(double clean, double draw) noexcept;

  PhaseFilterConfig config_;
  PreparedPhaseModel prepared_;
  BatchByLevel<BatchNoise> torque_;
  BatchByLevel<double> acceleration_;
  std::vector<double> knee_sigma_;  ///< by level of torque noise
  std::vector<double> wheel_sigma_;
  NoiseEstimates knee_noise_;  ///< by level of torque noise
  NoiseEstimates wheel_noise_;
  std::array<std::vector<double>, 2> knee_;  ///< noisy torques of both legs, by level
  std::array<std::vector<double>, 2> wheel_;
  std::vector<AccelerationLevel> acceleration_levels_;
  PhaseLikelihoods torque_likelihoods_;  ///< of both legs together
  PhaseLikelihoods acceleration_likelihoods_;
  BatchedPhaseRecursion recursion_;
  /// By element, padded as the blocks of the recursion.
  std::array<std::vector<double>, 2> p_contact_;
  std::array<std::vector<double>, 2> contact_;
};

}  // namespace touchdown::experiments
