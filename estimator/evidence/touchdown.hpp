#pragma once

#include "estimator/contact_estimator.hpp"
#include "estimator/decision/config.hpp"
#include "estimator/decision/logit_decision.hpp"
#include "estimator/decision/network.hpp"
#include "estimator/evidence/curves.hpp"

namespace touchdown {

/// What `TouchdownEstimator` was fitted to be.
struct TouchdownModel {
  EvidenceModel evidence;
  DecisionModel network;

  bool operator==(const TouchdownModel&) const = default;
};

/// Evidence curves and the decision network, which hear the same, side by side: the logit is the
/// mean of theirs (docs/estimator.md). They err at different moments, so the mean errs less often
/// and changes its mind less often than either.
///
/// `update` never throws, allocates or locks, and never returns NaN. Without signals that it can
/// use it does as `LogitDecision`.
class TouchdownEstimator : public ContactEstimator {
 public:
  /// Throws InputError for numbers that are not finite and configurations that make no sense.
  explicit TouchdownEstimator(const TouchdownModel& model, const DecisionConfig& config = {});

  void reset() noexcept override { decision_.reset(); }
  const Belief& update(const Signals& signals) noexcept override;

 private:
  PairedEvidence evidence_;
  PairedDecisionNetwork network_;
  LogitDecision decision_;
};

}  // namespace touchdown
