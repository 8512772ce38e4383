#include "estimator/evidence/filter.hpp"

#include "estimator/evidence/contributions.hpp"

namespace touchdown {

namespace {

const EvidenceCurveSets& checked(const EvidenceCurveSets& sets) {
  check_evidence_curve_sets(sets);
  return sets;
}

}  // namespace

EvidenceCurves::EvidenceCurves(const EvidenceCurveSets& sets, const DecisionConfig& config)
    : sets_(checked(sets)), usual_(sets.usual), decision_(config, !sets.usual.servo_curve.empty()) {
  if (sets.without_targets) without_targets_.emplace(*sets.without_targets);
}

Evidence EvidenceCurves::evidence() const noexcept {
  const EvidenceModel& model = lacks_targets() ? *sets_.without_targets : sets_.usual;
  Evidence evidence;
  if (has_inputs_[0]) {
    evidence.contributions[0] =
        evidence_contributions(model, decision_.left_inputs(), decision_.left_servo_load());
  }
  if (has_inputs_[1]) {
    evidence.contributions[1] =
        evidence_contributions(model, of_other_wheel(decision_.left_inputs()),
                               of_other_wheel(decision_.left_servo_load()));
  }
  return evidence;
}

const Belief& EvidenceCurves::estimate(const Signals& signals) noexcept {
  has_inputs_ = decision_.update(signals);
  std::array<float, 2> logits{};
  if (has_inputs_[0] || has_inputs_[1]) {
    decision_.compute_inputs();
    const PairedEvidence& evidence = lacks_targets() ? *without_targets_ : usual_;
    logits = evidence.logits(decision_.left_inputs(), decision_.left_servo_load());
  }
  return decision_.decide({logits[0], logits[1]});
}

}  // namespace touchdown
