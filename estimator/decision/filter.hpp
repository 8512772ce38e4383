#pragma once

#include "estimator/contact_estimator.hpp"
#include "estimator/decision/config.hpp"
#include "estimator/decision/logit_decision.hpp"
#include "estimator/decision/network.hpp"

namespace touchdown {

/// A small network that is fitted to decide rather than to model densities: for each wheel it hears
/// loads, the ground's reaction and the axle's motion of both legs, the vertical acceleration and
/// the roll rate, all at eight time scales, and how noisy they are (docs/estimator.md). Its belief
/// is decided by hysteresis.
///
/// `update` never throws, allocates or locks, and never returns NaN. Without signals that it can
/// use it does as `LogitDecision`.
class DecisionNetwork : public ContactEstimator {
 public:
  /// Throws InputError for weights that are not finite and configurations that make no sense.
  explicit DecisionNetwork(const DecisionModel& model, const DecisionConfig& config = {});

  void reset() noexcept override { decision_.reset(); }
  const Belief& update(const Signals& signals) noexcept override;

 private:
  PairedDecisionNetwork network_;
  LogitDecision decision_;
};

}  // namespace touchdown
