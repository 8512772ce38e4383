#pragma once

#include "estimator/contact_estimator.hpp"
#include "estimator/decision/config.hpp"
#include "estimator/decision/logit_decision.hpp"
#include "estimator/decision/network.hpp"

namespace touchdown {

/// A small network that is fitted to decide contact directly rather than to model densities. Its
/// inputs for each wheel are the load, the ground's reaction and the axle's motion of both legs,
/// the vertical acceleration and the roll rate, all at eight time scales, and the noise levels
/// (docs/explanation/estimator.md). Hysteresis turns its probability into a decision.
///
/// `update` never throws, allocates or locks, and never returns NaN. `LogitDecision` describes the
/// behaviour without usable signals.
class DecisionNetwork : public ContactEstimator {
 public:
  /// Throws InputError for weights that are not finite and for an invalid configuration.
  explicit DecisionNetwork(const DecisionModel& model, const DecisionConfig& config = {});

  void reset() noexcept override { decision_.reset(); }

 private:
  const Belief& estimate(const Signals& signals) noexcept override;

  PairedDecisionNetwork network_;
  LogitDecision decision_;
};

}  // namespace touchdown
