#pragma once

#include "estimator/contact_estimator.hpp"
#include "estimator/decision/config.hpp"
#include "estimator/decision/network.hpp"
#include "estimator/decision/senses.hpp"

namespace touchdown {

/// A small network that is fitted to decide rather than to model densities: for each wheel it hears
/// loads, the ground's reaction and the axle's motion of both legs, the vertical acceleration and
/// the roll rate, all at eight time scales, and how noisy they are (docs/estimator.md). Its belief
/// is decided by hysteresis.
///
/// `update` never throws, allocates or locks, and never returns NaN. A leg that cannot be used, or
/// that has frozen, is taken to fare like the other one by the other one's wheel, while its own
/// belief relaxes to the prior; without a usable IMU both do. The status says why. After that, as
/// after a gap, it goes on from what it knew before.
class DecisionNetwork : public ContactEstimator {
 public:
  /// Throws InputError for weights that are not finite and configurations that make no sense.
  explicit DecisionNetwork(const DecisionModel& model, const DecisionConfig& config = {});

  void reset() noexcept override;
  const Belief& update(const Signals& signals) noexcept override;

 private:
  DecisionConfig config_;
  PairedDecisionNetwork network_;
  DecisionSenses senses_;
  std::array<double, 2> logit_{};  ///< low-passed
  std::array<bool, 2> is_started_{};
  Belief belief_;
};

}  // namespace touchdown
