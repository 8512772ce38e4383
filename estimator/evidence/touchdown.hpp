#pragma once

#include "estimator/contact_estimator.hpp"
#include "estimator/decision/config.hpp"
#include "estimator/decision/logit_decision.hpp"
#include "estimator/decision/network.hpp"
#include "estimator/evidence/curves.hpp"

namespace touchdown {

/// The fitted model of `TouchdownEstimator`.
struct TouchdownModel {
  EvidenceModel evidence;
  DecisionModel network;

  bool operator==(const TouchdownModel&) const = default;
};

/// Evidence curves and the decision network side by side, with the same inputs. The logit is the
/// mean of their logits (docs/explanation/estimator.md). They err at different times, so the mean
/// has fewer errors and fewer changes of decision than either.
///
/// `update` never throws, allocates or locks, and never returns NaN. `LogitDecision` describes the
/// behaviour without usable signals.
class TouchdownEstimator : public ContactEstimator {
 public:
  /// Throws InputError for numbers that are not finite and for an invalid configuration.
  explicit TouchdownEstimator(const TouchdownModel& model, const DecisionConfig& config = {});

  void reset() noexcept override { decision_.reset(); }

 private:
  const Belief& estimate(const Signals& signals) noexcept override;

  PairedEvidence evidence_;
  PairedDecisionNetwork network_;
  LogitDecision decision_;
};

}  // namespace touchdown
