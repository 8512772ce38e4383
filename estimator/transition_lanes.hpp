#pragma once

#include <span>
#include <vector>

#include "estimator/transition_model.hpp"

namespace touchdown {

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

  /// Per sigma.
  [[nodiscard]] std::span<const Transition> transitions() const noexcept { return transitions_; }

 private:
  TransitionLaw law_;
  SlidingDft clean_;
  SlidingDft noise_;
  SpectrumSummary summary_;
  std::vector<double> sigmas_;
  std::vector<SpectrumValues> spectra_;
  std::vector<Transition> transitions_;
};

}  // namespace touchdown
