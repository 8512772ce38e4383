#include "estimator/evidence/filter.hpp"

#include "estimator/evidence/contributions.hpp"

namespace touchdown {

namespace {

const EvidenceModel& checked(const EvidenceModel& model) {
  check_evidence_model(model);
  return model;
}

}  // namespace

EvidenceCurves::EvidenceCurves(const EvidenceModel& model, const DecisionConfig& config)
    : model_(checked(model)), evidence_(model), decision_(config, !model.servo_curve.empty()) {}

Evidence EvidenceCurves::evidence() const noexcept {
  Evidence evidence;
  if (has_inputs_[0]) {
    evidence.contributions[0] =
        evidence_contributions(model_, decision_.left_inputs(), decision_.left_servo_load());
  }
  if (has_inputs_[1]) {
    evidence.contributions[1] =
        evidence_contributions(model_, of_other_wheel(decision_.left_inputs()),
                               of_other_wheel(decision_.left_servo_load()));
  }
  return evidence;
}

const Belief& EvidenceCurves::estimate(const Signals& signals) noexcept {
  has_inputs_ = decision_.update(signals);
  std::array<float, 2> logits{};
  if (has_inputs_[0] || has_inputs_[1]) {
    decision_.compute_inputs();
    logits = evidence_.logits(decision_.left_inputs(), decision_.left_servo_load());
  }
  return decision_.decide({logits[0], logits[1]});
}

}  // namespace touchdown
