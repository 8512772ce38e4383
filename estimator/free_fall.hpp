#pragma once

#include "estimator/contact_estimator.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

struct FreeFallConfig {
  /// Rate at which `update` is called (Hz).
  double sample_rate = 1000.0;
  /// Time constant of the low-pass of the vertical acceleration (s).
  double low_pass = 0.01;
  /// P(contact) is 0.5 at this acceleration (m/s²), half way between standing and falling.
  double half_way = -4.9;
  /// P(contact) = 1 / (1 + exp(−(acceleration − half_way) / width)) (m/s²).
  double width = 1.0;
  SignalGuardConfig guard = {};
};

/// The simplest baseline: a robot in free fall accelerates downwards at g. It thresholds one
/// low-passed acceleration, uses no torques and has nothing to fit. Both wheels get the same
/// belief. It detects only free fall: not hanging, being lifted, or one wheel over an edge.
///
/// `update` never throws, allocates or locks, and never returns NaN. While the acceleration is not
/// usable, the belief relaxes to the prior and the status gives the reason.
class FreeFall : public ContactEstimator {
 public:
  /// Throws InputError for a rate or width that is not positive and a negative time constant.
  explicit FreeFall(const FreeFallConfig& config = {});

  void reset() noexcept override;

 private:
  const Belief& estimate(const Signals& signals) noexcept override;

  FreeFallConfig config_;
  SignalGuard guard_;
  double gain_;
  double acceleration_ = 0.0;
  double p_contact_ = 0.5;
  Belief belief_;
};

}  // namespace touchdown
