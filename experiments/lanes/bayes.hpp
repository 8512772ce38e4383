#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "experiments/lanes/measurement.hpp"
#include "experiments/lanes/noise_level.hpp"
#include "experiments/lanes/transition.hpp"

namespace touchdown::experiments {

/// `BayesFilter` under many noise levels side by side, for sweeps: one clean recording and one
/// noise realisation, one lane per level, structures of arrays inside. Lanes that share their
/// torque noise share lookups and lanes that share their accelerometer noise share spectra, so that
/// a grid of levels costs little more than its recursions. Each lane's beliefs equal those of a
/// `BayesFilter` that is fed clean + sigma × draw, to 1e-12.
///
/// Meant for recordings: unlike `BayesFilter` it has no guard against gaps or frozen sensors; a
/// step with a value that is not finite is skipped, which leaves the beliefs as they were. `update`
/// neither allocates nor throws.
class BayesFilterLanes {
 public:
  /// Throws InputError for no levels, a level that is negative or not finite, a bad configuration.
  BayesFilterLanes(MeasurementModel model, const BayesFilterConfig& config,
                   std::span<const LaneNoise> levels);

  void reset() noexcept;

  /// One step of the clean signals, with the draws that every lane scales by its own sigmas.
  void update(const Signals& clean, const NoiseStep& draws) noexcept;

  [[nodiscard]] std::size_t lanes() const noexcept { return torque_index_.size(); }
  /// P(S_t = C | m_0:t) of one wheel, per lane in the order of the levels.
  [[nodiscard]] std::span<const double> p_contact(Side side) const noexcept {
    return contact_[static_cast<std::size_t>(side)];
  }
  /// P_τ(S_t = C | m_t), Eq. (14), of one wheel in one lane: the measurement-only ablation with the
  /// same torques.
  [[nodiscard]] double p_measurement(Side side, std::size_t lane) const noexcept {
    const std::uint32_t i = torque_index_[lane];
    return measurement_probability(
        {measurement_.contact(side)[i], measurement_.no_contact(side)[i]});
  }

 private:
  MeasurementLanes measurement_;
  TransitionLanes transition_;
  /// Which of the different torque and accelerometer levels each lane uses.
  std::vector<std::uint32_t> torque_index_;
  std::vector<std::uint32_t> acceleration_index_;
  /// bel(S_t = C) and bel(S_t = ¬C) per wheel and lane.
  std::array<std::vector<double>, 2> contact_;
  std::array<std::vector<double>, 2> no_contact_;
};

}  // namespace touchdown::experiments
