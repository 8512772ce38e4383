#include "estimator/evidence/filter.hpp"

namespace touchdown {

namespace {

/// Channels of a leg, in the order of `DecisionInputs`.
enum LegChannel : std::size_t {
  load_channel,
  ground_torque_channel,
  axle_velocity_channel,
  axle_acceleration_channel
};

const EvidenceCurveSets& checked(const EvidenceCurveSets& sets) {
  check_evidence_curve_sets(sets);
  return sets;
}

}  // namespace

Evidence::Contributions evidence_contributions(const EvidenceModel& model,
                                               const DecisionInputs& inputs,
                                               const ServoLoadInputs& servo) noexcept {
  const auto channel = [&](std::size_t number) {
    double sum = 0.0;
    for (std::size_t i = number * decision_scales; i < (number + 1) * decision_scales; ++i) {
      sum += static_cast<double>(evidence_at(model.curve[i], inputs[i]));
    }
    return sum;
  };
  const auto servo_load = [&](std::size_t leg) {
    double sum = 0.0;
    if (model.servo_curve.empty()) return sum;
    for (std::size_t i = leg * decision_scales; i < (leg + 1) * decision_scales; ++i) {
      sum += static_cast<double>(evidence_at(model.servo_curve[i], servo[i]));
    }
    return sum;
  };
  Evidence::Contributions all;
  all.load = channel(load_channel) + servo_load(0);
  all.ground_torque = channel(ground_torque_channel);
  all.axle_motion = channel(axle_velocity_channel) + channel(axle_acceleration_channel);
  all.other_leg = servo_load(1);
  for (std::size_t i = decision_leg_channels; i < 2 * decision_leg_channels; ++i) {
    all.other_leg += channel(i);
  }
  all.torso = channel(2 * decision_leg_channels) + channel(2 * decision_leg_channels + 1);
  all.offset = static_cast<double>(model.bias);
  for (std::size_t i = decision_channels * decision_scales; i < decision_inputs; ++i) {
    all.offset += static_cast<double>(evidence_at(model.curve[i], inputs[i]));
  }
  return all;
}

EvidenceCurves::EvidenceCurves(const EvidenceCurveSets& sets, const DecisionConfig& config)
    : sets_(checked(sets)), usual_(sets.usual), decision_(config, !sets.usual.servo_curve.empty()) {
  if (sets.without_targets) without_targets_.emplace(*sets.without_targets);
}

Evidence EvidenceCurves::evidence() const noexcept {
  const EvidenceModel& model = lacks_targets() ? *sets_.without_targets : sets_.usual;
  const FeatureExtractor& features = decision_.features();
  Evidence evidence;
  for (std::size_t side = 0; side < 2; ++side) {
    if (!has_inputs_[side]) continue;
    evidence.contributions[side] =
        evidence_contributions(model, features.inputs(side), features.servo_load(side));
  }
  return evidence;
}

const Belief& EvidenceCurves::estimate(const Signals& signals) noexcept {
  has_inputs_ = decision_.update(signals);
  std::array<float, 2> logits{};
  if (has_inputs_[0] || has_inputs_[1]) {
    FeatureExtractor& features = decision_.features();
    features.compute_inputs();
    const PairedEvidence& evidence = lacks_targets() ? *without_targets_ : usual_;
    logits = evidence.logits(features.left_inputs(), features.left_servo_load());
  }
  return decision_.decide({logits[0], logits[1]});
}

}  // namespace touchdown
