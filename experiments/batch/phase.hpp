#pragma once

#include <array>
#include <span>
#include <vector>

#include "estimator/phase/prepared_model.hpp"
#include "experiments/batch/noise_level.hpp"

namespace touchdown::experiments {

/// `PhaseFilter` under many noise levels side by side, for sweeps: one clean recording and one
/// noise realisation, one lane per level. Lanes that share their torque noise share the torques'
/// lookups and noise estimate, lanes that share their accelerometer noise likewise, and only the
/// recursion is every lane's own. Each lane's beliefs and decisions equal those of a `PhaseFilter`
/// that is fed clean + sigma × draw.
///
/// Meant for recordings: it has no guard against gaps or frozen sensors, and all inputs must be
/// finite. `update` neither allocates nor throws.
class BatchedPhaseFilter {
 public:
  /// Throws InputError as `PhaseFilter`, and for no levels or bad ones.
  BatchedPhaseFilter(const PhaseModel& model, const PhaseFilterConfig& config,
             std::span<const BatchNoise> levels);

  /// One step of the clean signals, with the draws that every lane scales by its own sigmas.
  void update(const Signals& clean, const NoiseStep& draws) noexcept;

  [[nodiscard]] std::size_t lanes() const noexcept { return alpha_.size(); }
  /// P(S_t = C | m_0:t) of one wheel, per lane in the order of the levels.
  [[nodiscard]] std::span<const double> p_contact(Side side) const noexcept {
    return p_contact_[static_cast<std::size_t>(side)];
  }
  /// The decision about one wheel, per lane: 1 for contact, 0 for none.
  [[nodiscard]] std::span<const double> contact(Side side) const noexcept {
    return contact_[static_cast<std::size_t>(side)];
  }

 private:
  /// Everything that depends on one level of torque noise.
  struct TorqueLevel {
    double knee_sigma;
    double wheel_sigma;
    NoiseEstimate<2> knee_noise;
    NoiseEstimate<2> wheel_noise;
    PhaseRow left{};
    PhaseRow right{};
  };
  /// Everything that depends on one level of accelerometer noise.
  struct AccelerationLevel {
    double sigma;
    NoiseEstimate<1> noise;
    PhaseRow row{};
  };

  PhaseFilterConfig config_;
  PreparedPhaseModel prepared_;
  BatchByLevel<BatchNoise> torque_;
  BatchByLevel<double> acceleration_;
  std::vector<TorqueLevel> torque_levels_;
  std::vector<AccelerationLevel> acceleration_levels_;
  std::vector<PhaseRecursion::Lanes> alpha_;
  std::array<std::vector<double>, 2> p_contact_;
  std::array<std::vector<double>, 2> contact_;
};

}  // namespace touchdown::experiments
