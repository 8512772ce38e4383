#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "estimator/phase/prepared_model.hpp"
#include "experiments/batch/noise_level.hpp"

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
  /// The number of recursions that run side by side: doubles in a vector of 512 bits.
  static constexpr int block_size = 8;

  /// Throws InputError as `PhaseFilter`, and for no levels or bad ones.
  BatchedPhaseFilter(std::shared_ptr<const PhaseModel> model, const PhaseFilterConfig& config,
                     std::span<const BatchNoise> levels);

  /// Processes one step of clean signals. Each element scales the draws by its own sigmas.
  void update(const Signals& clean, const NoiseStep& draws) noexcept;

  /// P(S_t = C | m_0:t) of one wheel, per noise level.
  [[nodiscard]] std::span<const double> p_contact(Side side) const noexcept {
    return std::span(p_contact_[static_cast<std::size_t>(side)]).first(torque_.index.size());
  }
  /// The decision about one wheel, per noise level: 1 for contact, 0 for none.
  [[nodiscard]] std::span<const double> contact(Side side) const noexcept {
    return std::span(contact_[static_cast<std::size_t>(side)]).first(torque_.index.size());
  }

 private:
  /// Torques of both legs with one standard deviation of noise, and its estimates.
  struct JointTorques {
    NoiseEstimate<2> knee_noise;
    NoiseEstimate<2> wheel_noise;
    std::array<double, 2> knee{};
    std::array<double, 2> wheel{};
  };
  void update_torques(const Signals& clean, const NoiseStep& draws) noexcept;
  void update_accelerations(double clean, double draw) noexcept;
  void update_block(std::size_t block) noexcept;

  PhaseFilterConfig config_;
  PreparedPhaseModel prepared_;
  Distinct<BatchNoise> torque_;
  Distinct<double> sigmas_;            ///< of the levels of torque noise
  std::vector<JointTorques> joint_;    ///< by standard deviation
  std::vector<PhaseRow> torque_rows_;  ///< log likelihoods of both legs, by level of torque noise
  Distinct<double> acceleration_;
  std::vector<NoiseEstimate<1>> acceleration_noise_;
  std::vector<PhaseRow> acceleration_rows_;
  std::vector<PhaseValues<block_size>> alpha_;
  /// By element, padded to whole blocks.
  std::array<std::vector<double>, 2> p_contact_;
  std::array<std::vector<double>, 2> contact_;
};

}  // namespace touchdown::experiments
