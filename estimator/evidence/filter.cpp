#include "estimator/evidence/filter.hpp"

namespace touchdown {

namespace {

const EvidenceModel& checked(const EvidenceModel& model) {
  check_evidence_model(model);
  return model;
}

}  // namespace

EvidenceCurves::EvidenceCurves(const EvidenceModel& model, const DecisionConfig& config)
    : evidence_(checked(model)), decision_(config, !model.servo_curve.empty()) {}

const Belief& EvidenceCurves::estimate(const Signals& signals) noexcept {
  const std::array<bool, 2>& is_valid = decision_.update(signals);
  std::array<float, 2> logits{};
  if (is_valid[0] || is_valid[1]) {
    decision_.compute_inputs();
    logits = evidence_.logits(decision_.left_inputs(), decision_.left_servo_load());
  }
  return decision_.decide({logits[0], logits[1]});
}

}  // namespace touchdown
