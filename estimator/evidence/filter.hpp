#pragma once

#include <array>
#include <optional>

#include "estimator/contact_estimator.hpp"
#include "estimator/decision/config.hpp"
#include "estimator/decision/logit_decision.hpp"
#include "estimator/evidence/curves.hpp"

namespace touchdown {

/// What the inputs of one wheel add to its log-odds, by groups of channels (nats). The groups add
/// up to `evidence_logit`, but for rounding.
[[nodiscard]] Evidence::Contributions evidence_contributions(
    const EvidenceModel& model, const DecisionInputs& inputs,
    const ServoLoadInputs& servo = {}) noexcept;

/// The interpretable counterpart of the decision network: an additive model (GAM) with the same
/// inputs and the same decision rule. Each input contributes to the log-odds of contact by a curve
/// of its own, and the contributions add up (docs/explanation/estimator.md).
///
/// A fit with the load by the servo law has two sets of curves. At each step the estimator uses the
/// one that its signals allow; both share the features and the low-passed logit. Steps without
/// targets have the status `degraded`.
///
/// `update` never throws, allocates or locks, and never returns NaN. `LogitDecision` describes the
/// behaviour without usable signals.
class EvidenceCurves : public ContactEstimator {
 public:
  /// Throws InputError as `check_evidence_curve_sets` does, and for an invalid configuration.
  explicit EvidenceCurves(const EvidenceCurveSets& sets, const DecisionConfig& config = {});

  void reset() noexcept override {
    decision_.reset();
    has_inputs_ = {};
  }

  /// The contributions at the last step, of wheels that its signals are usable for.
  [[nodiscard]] Evidence evidence() const noexcept override;

 private:
  const Belief& estimate(const Signals& signals) noexcept override;
  [[nodiscard]] bool lacks_targets() const noexcept {
    return without_targets_ && decision_.features().is_servo_load_muted();
  }

  EvidenceCurveSets sets_;
  PairedEvidence usual_;
  std::optional<PairedEvidence> without_targets_;
  LogitDecision decision_;
  std::array<bool, 2> has_inputs_{};  ///< whether the last step has; left, right
};

}  // namespace touchdown
