#pragma once

#include "estimator/contact_estimator.hpp"
#include "estimator/decision/config.hpp"
#include "estimator/decision/logit_decision.hpp"
#include "estimator/evidence/curves.hpp"

namespace touchdown {

/// The decision network's transparent twin: it hears the same and decides alike, but each input
/// speaks for contact or against it by a curve of its own, and what they say is added
/// (docs/estimator.md).
///
/// `update` never throws, allocates or locks, and never returns NaN. Without signals that it can
/// use it does as `LogitDecision`.
class EvidenceCurves : public ContactEstimator {
 public:
  /// Throws InputError as `check_evidence_model` and for configurations that make no sense.
  explicit EvidenceCurves(const EvidenceModel& model, const DecisionConfig& config = {});

  void reset() noexcept override { decision_.reset(); }
  const Belief& update(const Signals& signals) noexcept override;

 private:
  PairedEvidence evidence_;
  LogitDecision decision_;
};

}  // namespace touchdown
