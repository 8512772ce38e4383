#pragma once

#include "estimator/contact_estimator.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

struct FreeFallConfig {
  /// Rate at which `update` is called (Hz).
  double sample_rate = 1000.0;
  /// Time constant of the low-pass of the vertical acceleration (s).
  double low_pass = 0.01;
  /// P(contact) is 0.5 where the acceleration is this (m/s²): half way between standing and
  /// falling.
  double half_way = -4.9;
  /// P(contact) = 1 / (1 + exp(−(acceleration − half_way) / width)) (m/s²).
  double width = 1.0;
  SignalGuardConfig guard = {};
};

/// The baseline that anyone would try first: what falls freely accelerates downwards at g. One
/// low-passed acceleration, one threshold, nothing to fit, no torques; both wheels get the same
/// answer. Blind to everything but free fall: hanging, being lifted, one wheel over an edge.
///
/// `update` never throws, allocates or locks, and never returns NaN. While the acceleration is not
/// usable the belief relaxes to the prior and the status says why.
class FreeFall : public ContactEstimator {
 public:
  /// Throws InputError for a rate or width that is not positive and a negative time constant.
  explicit FreeFall(const FreeFallConfig& config = {});

  void reset() noexcept override;
  const Belief& update(const Signals& signals) noexcept override;

 private:
  FreeFallConfig config_;
  SignalGuard guard_;
  double gain_;
  double acceleration_ = 0.0;
  double p_contact_ = 0.5;
  Belief belief_;
};

}  // namespace touchdown
