#pragma once

#include "estimator/contact_estimator.hpp"
#include "estimator/decision/config.hpp"
#include "estimator/decision/logit_decision.hpp"
#include "estimator/evidence/curves.hpp"

namespace touchdown {

/// The interpretable counterpart of the decision network: an additive model (GAM) with the same
/// inputs and the same decision rule. Each input contributes to the log-odds of contact by a curve
/// of its own, and the contributions add up (docs/explanation/estimator.md).
///
/// `update` never throws, allocates or locks, and never returns NaN. `LogitDecision` describes the
/// behaviour without usable signals.
class EvidenceCurves : public ContactEstimator {
 public:
  /// Throws InputError as `check_evidence_model` does, and for an invalid configuration.
  explicit EvidenceCurves(const EvidenceModel& model, const DecisionConfig& config = {});

  void reset() noexcept override {
    decision_.reset();
    has_inputs_ = {};
  }

  /// The contributions at the last step, of wheels that its signals are usable for.
  [[nodiscard]] Evidence evidence() const noexcept override;

 private:
  const Belief& estimate(const Signals& signals) noexcept override;

  EvidenceModel model_;
  PairedEvidence evidence_;
  LogitDecision decision_;
  std::array<bool, 2> has_inputs_{};  ///< whether the last step has; left, right
};

}  // namespace touchdown
